#include "physics/solver/impulse_set.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace careen {
namespace {

using Triple = ContactProblem::Triple;

double length(double x, double y) { return std::sqrt(x * x + y * y); }

/// Brings a vector of that size into the disc; 1 within it.
double shrinkInto(double radius, double size) { return size <= radius ? 1 : radius / size; }

/// Radius μ x_n > 0, |x_t| > radius. Along τ = x_t/|x_t|, λ_t follows μ λ_n; across it, it turns with u_t:
/// A = [1, 0; μ τ, κ (I − τ τᵀ)] with κ = radius/|x_t|.
ContactAnswer slippingAnswer(const ImpulseSet& set, const ContactEquation& equation, const Triple& impulse,
                             const Triple& centre, const Triple& u, const std::array<double, 2>& x,
                             double radius) {
  const double epsilon = equation.epsilon;
  const double stiff = equation.rho / epsilon;
  const double mu = set.friction;
  const double size = length(x[0], x[1]);
  const double kappa = radius / size;
  const std::array<double, 2> to{x[0] / size, x[1] / size};
  const std::array<double, 2> across{-to[1], to[0]};
  const auto part = [](const Triple& of, const std::array<double, 2>& direction) {
    return of[1] * direction[0] + of[2] * direction[1];
  };
  const double normal = centre[0] - stiff * u[0];
  const double along = (radius + epsilon * part(centre, to) + mu * (normal - impulse[0])) / (1 + epsilon);
  const double aside =
      (epsilon * part(centre, across) - kappa * part(impulse, across)) / (1 + epsilon - kappa);
  const double turn = equation.rho * kappa / (1 + epsilon - kappa);
  ContactAnswer answer;
  answer.given = {normal, along * to[0] + aside * across[0], along * to[1] + aside * across[1]};
  answer.stiffness[0] = stiff;
  for (std::size_t row = 0; row < 2; ++row) {
    double* of = &answer.stiffness[3 * (row + 1)];
    of[0] = mu * stiff * to[row];
    of[1] = turn * (across[row] * across[0]);
    of[2] = turn * (across[row] * across[1]);
  }
  return answer;
}

}  // namespace

double ImpulseSet::violation(const Triple& impulse, const Triple& u) const {
  if (kind == Kind::kSpace) {
    return std::sqrt(u[0] * u[0] + (u[1] * u[1] + u[2] * u[2]));
  }
  if (kind == Kind::kInterval) {
    const double x = impulse[0] - mass * u[0];
    return x >= least && x <= most ? std::fabs(u[0])  // not rounded
                                   : std::fabs(impulse[0] - std::clamp(x, least, most)) / mass;
  }
  const double normal = impulse[0] / mass;
  const double open = std::min(normal, u[0]);  // normal − max(0, normal − u_n), but not rounded
  if (kind == Kind::kLine) {
    return std::fabs(open);
  }
  const double x = impulse[1] / mass - u[1];
  const double y = impulse[2] / mass - u[2];
  const double shrink = shrinkInto(limit(std::max(0.0, normal)), length(x, y));
  const double dx = shrink == 1 ? u[1] : impulse[1] / mass - shrink * x;  // u_t within it, but not rounded
  const double dy = shrink == 1 ? u[2] : impulse[2] / mass - shrink * y;
  return std::sqrt(open * open + (dx * dx + dy * dy));
}

Triple ImpulseSet::admissible(const Triple& impulse) const {
  if (kind == Kind::kSpace) {
    return impulse;
  }
  if (kind == Kind::kInterval) {
    return {std::clamp(impulse[0], least, most), 0, 0};
  }
  if (!(impulse[0] > 0)) {
    return {};
  }
  if (kind == Kind::kLine) {
    return {impulse[0], drag[0] * impulse[0], drag[1] * impulse[0]};
  }
  const double shrink = shrinkInto(limit(impulse[0]), length(impulse[1], impulse[2]));
  return {impulse[0], shrink * impulse[1], shrink * impulse[2]};
}

ContactAnswer stickingAnswer(const ImpulseSet& set, const ContactEquation& equation, const Triple& centre,
                             const Triple& u) {
  if (set.isGiven()) {
    return {.given = {set.least, 0, 0}};
  }
  const double stiff = equation.rho / equation.epsilon;
  ContactAnswer answer;
  answer.given[0] = centre[0] - stiff * u[0];
  answer.stiffness[0] = stiff;
  for (std::size_t k = 1; k < 3; ++k) {
    if (set.kind == ImpulseSet::Kind::kLine) {
      answer.given[k] = set.drag[k - 1] * answer.given[0];
      answer.stiffness[3 * k] = set.drag[k - 1] * stiff;
    } else {
      answer.given[k] = centre[k] - stiff * u[k];
      answer.stiffness[4 * k] = stiff;
    }
  }
  return answer;
}

ContactAnswer newtonAnswer(const ImpulseSet& set, const ContactEquation& equation, const Triple& impulse,
                           const Triple& centre, const Triple& u) {
  if (set.kind == ImpulseSet::Kind::kSpace) {
    return stickingAnswer(set, equation, centre, u);
  }
  const double normal = impulse[0] - equation.rho * u[0];
  if (set.kind == ImpulseSet::Kind::kInterval) {
    const double end = std::clamp(normal, set.least, set.most);
    return end == normal && !set.isGiven()
               ? stickingAnswer(set, equation, centre, u)
               : ContactAnswer{
                     .given = {(end + equation.epsilon * centre[0]) / (1 + equation.epsilon), 0, 0}};
  }
  if (!(normal > 0)) {
    return {};
  }
  const std::array<double, 2> x{impulse[1] - equation.rho * u[1], impulse[2] - equation.rho * u[2]};
  const double radius = set.limit(normal);
  if (set.kind == ImpulseSet::Kind::kLine || length(x[0], x[1]) <= radius) {
    return stickingAnswer(set, equation, centre, u);
  }
  return slippingAnswer(set, equation, impulse, centre, u, x, radius);
}

double equationError(const ImpulseSet& set, const ContactEquation& equation, const Triple& impulse,
                     const Triple& centre, const Triple& u) {
  const double rho = equation.rho;
  const Triple x =
      set.admissible({impulse[0] - rho * u[0], impulse[1] - rho * u[1], impulse[2] - rho * u[2]});
  double sum = 0;
  for (std::size_t k = 0; k < (set.kind == ImpulseSet::Kind::kLine ? 1 : 3); ++k) {
    const double error = (impulse[k] - x[k] + equation.epsilon * (impulse[k] - centre[k])) / rho;
    sum += error * error;
  }
  return std::sqrt(sum);
}

}  // namespace careen
