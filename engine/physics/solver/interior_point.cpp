#include "physics/solver/interior_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace careen {
namespace {

using Triple = ContactProblem::Triple;
using Contact = CoupledContacts::Contact;

/// xᵀ J x = x_0² − |x_t|².
double determinant(const Triple& x) {
  const double size = std::sqrt(x[1] * x[1] + x[2] * x[2]);
  return (x[0] - size) * (x[0] + size);
}
double dot(const Triple& x, const Triple& y) { return x[0] * y[0] + (x[1] * y[1] + x[2] * y[2]); }

/// x ∘ y.
Triple jordan(const Triple& x, const Triple& y) {
  return {dot(x, y), x[0] * y[1] + y[0] * x[1], x[0] * y[2] + y[0] * x[2]};
}

/// z with x ∘ z = y.
Triple jordanQuotient(const Triple& x, const Triple& y) {
  const double first = (x[0] * y[0] - (x[1] * y[1] + x[2] * y[2])) / determinant(x);
  return {first, (y[1] - first * x[1]) / x[0], (y[2] - first * x[2]) / x[0]};
}

/// η² (2 w̄w̄ᵀ − J) x.
Triple scaledTwice(const Triple& point, double size2, const Triple& x) {
  const double along = 2 * dot(point, x);
  return {size2 * (along * point[0] - x[0]), size2 * (along * point[1] + x[1]), size2 * (along * point[2] + x[2])};
}

/// W x, with the square root of 2 w̄w̄ᵀ − J in closed form.
Triple scaledOnce(const Triple& point, double size, const Triple& x) {
  const double along = point[1] * x[1] + point[2] * x[2];
  const double factor = x[0] + along / (1 + point[0]);
  return {size * (point[0] * x[0] + along), size * (x[1] + factor * point[1]), size * (x[2] + factor * point[2])};
}

/// Largest α with x + α d in the cone.
double reach(const Triple& x, const Triple& d) {
  const double a = d[0] * d[0] - (d[1] * d[1] + d[2] * d[2]);
  const double b = x[0] * d[0] - (x[1] * d[1] + x[2] * d[2]);
  const double c = determinant(x);
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const double discriminant = b * b - a * c;
  if (discriminant < 0) {
    return kFar;
  }
  const double root = std::sqrt(discriminant);
  if (b >= 0) {  // roots (−b ∓ root)/a; the positive one exists for a < 0 only
    return a < 0 ? (b + root) / -a : kFar;
  }
  return c / (root - b);
}

}  // namespace

/// r and w at the centre.
void InteriorPoint::start(const CoupledContacts& contacts, const Options& options) {
  options_ = options;
  const std::size_t count = contacts.contacts().size();
  states_.resize(count);
  answers_.resize(count);
  impulses_.resize(count);
  q_.resize(contacts.bodies() * CoupledContacts::kAxes);
  dq_.resize(q_.size());
  for (State& state : states_) {
    state.r = {options.start * contacts.scale(), 0, 0};
    state.w = {contacts.scale(), 0, 0};
  }
  refresh(contacts);
}

void InteriorPoint::startAt(const CoupledContacts& contacts, std::span<const Triple> impulses, double shift,
                            const Options& options) {
  start(contacts, options);
  contacts.velocities(impulses, q_);
  for (std::size_t c = 0; c < states_.size(); ++c) {
    const Contact& contact = contacts.contacts()[c];
    const Triple u = contacts.relativeVelocity(contact, q_);
    State& state = states_[c];
    if (contact.onLine) {
      state.r[0] = std::max(0.0, impulses[c][0] / contact.mass) + shift;
      state.w[0] = std::max(0.0, u[0]) + shift;
      continue;
    }
    const double slip = std::sqrt(u[1] * u[1] + u[2] * u[2]);
    state.r = {0, impulses[c][1] / contact.mass, impulses[c][2] / contact.mass};
    state.r[0] = std::max(contact.friction * impulses[c][0] / contact.mass,
                          std::sqrt(state.r[1] * state.r[1] + state.r[2] * state.r[2])) +
                 shift;
    state.w = {std::max(u[0] / contact.friction, 0.0) + slip + shift, u[1], u[2]};
  }
  refresh(contacts);
}

/// Impulses, velocities and residuals that follow from r and w.
void InteriorPoint::refresh(const CoupledContacts& contacts) {
  for (std::size_t c = 0; c < states_.size(); ++c) {
    const Contact& contact = contacts.contacts()[c];
    const Triple& r = states_[c].r;
    const double normal = contact.mass * r[0];
    impulses_[c] = contact.onLine ? Triple{normal, contact.drag[0] * normal, contact.drag[1] * normal}
                                  : Triple{normal / contact.friction, contact.mass * r[1], contact.mass * r[2]};
  }
  contacts.velocities(impulses_, q_);
  double sum = 0;
  for (std::size_t c = 0; c < states_.size(); ++c) {
    const Contact& contact = contacts.contacts()[c];
    State& state = states_[c];
    const Triple u = contacts.relativeVelocity(contact, q_);
    if (contact.onLine) {
      state.residual = {state.w[0] - u[0], 0, 0};
    } else {
      const double slip = std::sqrt(u[1] * u[1] + u[2] * u[2]);
      state.slip = slip > 0 ? std::array<double, 2>{u[1] / slip, u[2] / slip} : std::array<double, 2>{};
      state.residual = {state.w[0] - (u[0] / contact.friction + slip), state.w[1] - u[1], state.w[2] - u[2]};
    }
    sum += dot(state.r, state.w);
  }
  gap_ = sum / static_cast<double>(states_.size());
}

/// Nesterov–Todd scaling and the contact's stiffness mass · S W² D̃ S with S = diag(1/μ, 1, 1), D̃ = d(u_0 + |u_t|, u_t)/du.
void InteriorPoint::scale(std::size_t c, const Contact& contact) {
  State& state = states_[c];
  auto& stiffness = answers_[c].stiffness;
  stiffness = {};
  if (contact.onLine) {
    state.size2 = state.r[0] / state.w[0];
    stiffness[0] = contact.mass * state.size2;
    stiffness[3] = contact.drag[0] * stiffness[0];
    stiffness[6] = contact.drag[1] * stiffness[0];
    return;
  }
  const double detR = determinant(state.r);
  const double detW = determinant(state.w);
  const double lengthR = std::sqrt(detR);
  const double lengthW = std::sqrt(detW);
  Triple& p = state.point;
  const double cosine = dot(state.r, state.w) / (lengthR * lengthW);
  const double norm = 1 / std::sqrt(2 * (1 + cosine));
  p = {(state.r[0] / lengthR + state.w[0] / lengthW) * norm, (state.r[1] / lengthR - state.w[1] / lengthW) * norm,
       (state.r[2] / lengthR - state.w[2] / lengthW) * norm};
  state.size2 = lengthR / lengthW;
  state.scaled = scaledOnce(p, std::sqrt(state.size2), state.w);
  const double inverse = 1 / contact.friction;
  for (std::size_t column = 0; column < 3; ++column) {
    Triple x{};  // D̃ S e
    if (column == 0) {
      x[0] = inverse;
    } else {
      x[0] = state.slip[column - 1];
      x[column] = 1;
    }
    const Triple y = scaledTwice(p, state.size2, x);
    stiffness[column] = contact.mass * inverse * y[0];
    stiffness[3 + column] = contact.mass * y[1];
    stiffness[6 + column] = contact.mass * y[2];
  }
}

/// Solves for the changes. Corrected: with the second-order term of those before.
void InteriorPoint::direct(const CoupledContacts& contacts, double centering, bool corrected) {
  for (std::size_t c = 0; c < states_.size(); ++c) {
    const Contact& contact = contacts.contacts()[c];
    State& state = states_[c];
    if (contact.onLine) {
      double given = centering * gap_ - (corrected ? state.changeR[0] * state.changeW[0] : 0);
      given = given / state.w[0] + state.size2 * state.residual[0];
      const double normal = contact.mass * given;
      answers_[c].given = {normal, contact.drag[0] * normal, contact.drag[1] * normal};
      continue;
    }
    const double size = std::sqrt(state.size2);
    Triple given = scaledTwice(state.point, state.size2, state.residual);
    const double target = centering * gap_ / determinant(state.w);
    given[0] += target * state.w[0];
    given[1] -= target * state.w[1];
    given[2] -= target * state.w[2];
    if (corrected) {
      const Triple y = scaledOnce(state.point, size, state.changeW);
      const Triple x{-state.scaled[0] - y[0], -state.scaled[1] - y[1], -state.scaled[2] - y[2]};
      const Triple term = scaledOnce(state.point, size, jordanQuotient(state.scaled, jordan(x, y)));
      for (std::size_t k = 0; k < 3; ++k) {
        given[k] -= term[k];
      }
    }
    answers_[c].given = {contact.mass * given[0] / contact.friction, contact.mass * given[1],
                         contact.mass * given[2]};
  }
  contacts.step(answers_, q_, dq_);
  for (std::size_t c = 0; c < states_.size(); ++c) {
    const Contact& contact = contacts.contacts()[c];
    State& state = states_[c];
    const Triple du = contacts.change(contact, dq_);
    const Triple& given = answers_[c].given;
    if (contact.onLine) {
      state.changeW = {du[0] - state.residual[0], 0, 0};
      state.changeR = {given[0] / contact.mass - state.size2 * du[0] - state.r[0], 0, 0};
      continue;
    }
    const Triple dw{du[0] / contact.friction + (state.slip[0] * du[1] + state.slip[1] * du[2]), du[1], du[2]};
    const Triple answer = scaledTwice(state.point, state.size2, dw);
    const Triple scaledGiven{given[0] * contact.friction / contact.mass, given[1] / contact.mass,
                             given[2] / contact.mass};
    for (std::size_t k = 0; k < 3; ++k) {
      state.changeW[k] = dw[k] - state.residual[k];
      state.changeR[k] = scaledGiven[k] - answer[k] - state.r[k];
    }
  }
}

double InteriorPoint::strideToSurface() const {
  double most = std::numeric_limits<double>::infinity();
  for (const State& state : states_) {
    most = std::min({most, reach(state.r, state.changeR), reach(state.w, state.changeW)});
  }
  return most;
}

bool InteriorPoint::advance(CoupledContacts& contacts) {
  for (std::size_t c = 0; c < states_.size(); ++c) {
    scale(c, contacts.contacts()[c]);
  }
  if (!contacts.factorise(answers_)) {
    return false;
  }
  direct(contacts, 0, false);
  const double affine = std::min(1.0, strideToSurface());
  const double left = 1 - affine;
  const double centering = std::max(options_.leastCentering, left * left * left);
  direct(contacts, centering, options_.secondOrder);
  const double stride = std::min(1.0, options_.stride * strideToSurface());
  if (!(stride > 0)) {
    return false;
  }
  for (State& state : states_) {
    for (std::size_t k = 0; k < 3; ++k) {
      state.r[k] += stride * state.changeR[k];
      state.w[k] += stride * state.changeW[k];
    }
  }
  for (const State& state : states_) {
    if (!(determinant(state.r) > 0 && determinant(state.w) > 0 && state.r[0] > 0 && state.w[0] > 0)) {
      return false;
    }
  }
  refresh(contacts);
  return std::isfinite(gap_);
}

}  // namespace careen
