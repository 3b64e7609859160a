#include "physics/solver/contact_cone.h"

#include <algorithm>

namespace careen {
namespace {

using Triple = ContactProblem::Triple;

double length(double x, double y) { return std::sqrt(x * x + y * y); }

}  // namespace

double ContactCone::violation(const Triple& impulse, const Triple& u) const {
  const double normal = impulse[0] / mass;
  const double open = normal - std::max(0.0, normal - u[0]);
  if (onLine) {
    return std::fabs(open);
  }
  const double x = impulse[1] / mass - u[1];
  const double y = impulse[2] / mass - u[2];
  const double size = length(x, y);
  const double limit = friction * std::max(0.0, normal);
  const double shrink = size > limit ? limit / size : 1;
  const double dx = impulse[1] / mass - shrink * x;
  const double dy = impulse[2] / mass - shrink * y;
  return std::sqrt(open * open + (dx * dx + dy * dy));
}

Triple ContactCone::admissible(const Triple& impulse) const {
  if (!(impulse[0] > 0)) {
    return {};
  }
  if (onLine) {
    return {impulse[0], drag[0] * impulse[0], drag[1] * impulse[0]};
  }
  const double size = length(impulse[1], impulse[2]);
  const double limit = friction * impulse[0];
  if (size <= limit) {
    return impulse;
  }
  const double shrink = limit / size;
  return {impulse[0], shrink * impulse[1], shrink * impulse[2]};
}

void answerSticking(const ContactCone& cone, const Triple& impulse, const Triple& u, double rho, double epsilon,
                    ContactAnswer& answer) {
  const double stiff = rho / epsilon;
  const double normal = impulse[0] - stiff * u[0];
  answer.stiffness = {};
  answer.stiffness[0] = stiff;
  if (cone.onLine) {
    answer.given = {normal, cone.drag[0] * normal, cone.drag[1] * normal};
    answer.stiffness[3] = cone.drag[0] * stiff;
    answer.stiffness[6] = cone.drag[1] * stiff;
    return;
  }
  answer.given = {normal, impulse[1] - stiff * u[1], impulse[2] - stiff * u[2]};
  answer.stiffness[4] = stiff;
  answer.stiffness[8] = stiff;
}

ContactMode answerByNewton(const ContactCone& cone, const Triple& impulse, const Triple& u, double rho,
                           double epsilon, ContactAnswer& answer) {
  const double normal = impulse[0] - rho * u[0];
  if (!(normal > 0)) {
    answer = {};
    return ContactMode::kOpen;
  }
  const double x = impulse[1] - rho * u[1];
  const double y = impulse[2] - rho * u[2];
  const double size = length(x, y);
  const double mu = cone.friction;
  const double limit = mu * normal;
  if (cone.onLine || size <= limit) {
    answerSticking(cone, impulse, u, rho, epsilon, answer);
    return ContactMode::kStick;
  }
  const double stiff = rho / epsilon;
  const std::array<double, 2> to{x / size, y / size};
  const std::array<double, 2> across{-to[1], to[0]};
  const double kappa = limit / size;
  // Along τ: λ_t → μ λ_n; across it, the direction turns with u_t.
  const double given = impulse[0] - stiff * u[0];
  const double along = impulse[1] * to[0] + impulse[2] * to[1];
  const double aside = impulse[1] * across[0] + impulse[2] * across[1];
  const double newAlong = along + ((limit - along) - mu * stiff * u[0]) / (1 + epsilon);
  const double newAside = aside - aside / (1 + epsilon - kappa);
  const double turn = rho * kappa / (1 + epsilon - kappa);
  answer.given = {given, newAlong * to[0] + newAside * across[0], newAlong * to[1] + newAside * across[1]};
  answer.stiffness = {stiff,
                      0,
                      0,
                      mu * stiff * to[0],
                      turn * (across[0] * across[0]),
                      turn * (across[0] * across[1]),
                      mu * stiff * to[1],
                      turn * (across[0] * across[1]),
                      turn * (across[1] * across[1])};
  return ContactMode::kSlip;
}

}  // namespace careen
