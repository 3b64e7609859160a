#include "physics/solver/interior_point.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/math/order_free_sum.h"
#include "physics/solver/lorentz_cone.h"

namespace careen {

namespace {

using Triple = ContactProblem::Triple;
using lorentz::determinant;
using lorentz::dot;
using lorentz::scaledOnce;
using lorentz::scaledTwice;

using Kind = ContactProblem::Admissible;
/// [1] of the effective mass: what holds without a cone.
constexpr double kStiff = 0x1p30;

/// [N s] λ of a contact's r [m/s].
Triple impulseOf(const CoupledContacts::Contact& contact, double friction, const Triple& r) {
  const double normal = contact.mass * r[0];
  switch (contact.kind) {
    case Kind::kLine:
      return {normal, contact.drag[0] * normal, contact.drag[1] * normal};
    case Kind::kCone:
      return {normal / friction, contact.mass * r[1], contact.mass * r[2]};
    case Kind::kInterval:
      return {contact.least + normal, 0, 0};
    case Kind::kSpace:
      break;
  }
  return {normal, contact.mass * r[1], contact.mass * r[2]};
}

}  // namespace

void InteriorPoint::start(const CoupledContacts& contacts, const Options& options,
                          std::span<const double> slips) {
  options_ = options;
  const std::size_t count = contacts.contacts().size();
  states_.resize(count);
  answers_.resize(count);
  impulses_.resize(count);
  q_.resize(contacts.bodies() * CoupledContacts::kAxes);
  dq_.resize(q_.size());
  lastStride_ = 1;
  for (std::size_t c = 0; c < count; ++c) {
    states_[c].friction = std::min(contacts.contacts()[c].friction, options.mostFriction);
    states_[c].r = {options.start * contacts.scale(), 0, 0};
    states_[c].w = {contacts.scale(), 0, 0};
    states_[c].slips = slips.empty() ? -1 : slips[c];
    const Contact& contact = contacts.contacts()[c];
    states_[c].isInterval = contact.kind == Kind::kInterval;
    states_[c].isFree = contact.kind == Kind::kSpace || contact.isGiven();
    if (states_[c].isFree) {
      states_[c].r = {};
      states_[c].w = {};
    } else if (contact.kind == Kind::kInterval) {
      const double half = (contact.most - contact.least) / contact.mass / 2;
      states_[c].r = {half, half, 0};
      states_[c].w = {contacts.scale(), contacts.scale(), 0};
    }
  }
  refresh(contacts);
}

/// Impulses, velocities, residuals and gap that follow from r and w.
void InteriorPoint::refresh(const CoupledContacts& contacts) {
  for (std::size_t c = 0; c < states_.size(); ++c) {
    const Contact& contact = contacts.contacts()[c];
    const State& state = states_[c];
    impulses_[c] = impulseOf(contact, state.friction, state.r);
  }
  contacts.velocities(impulses_, q_);
  products_.clear();
  for (std::size_t c = 0; c < states_.size(); ++c) {
    const Contact& contact = contacts.contacts()[c];
    State& state = states_[c];
    const Triple u = contacts.relativeVelocity(contact, q_);
    if (contact.kind == Kind::kSpace) {
      state.residual = {-u[0], -u[1], -u[2]};
    } else if (contact.kind == Kind::kInterval) {
      state.residual = {state.w[0] - state.w[1] - u[0], 0, 0};
    } else if (contact.kind == Kind::kLine) {
      state.residual = {state.w[0] - u[0], 0, 0};
    } else {
      const bool given = state.slips >= 0;
      const double slip = given ? state.slips : lorentz::tangentialSize(u);
      state.slip =
          slip > 0 && !given ? std::array<double, 2>{u[1] / slip, u[2] / slip} : std::array<double, 2>{};
      state.residual = {state.w[0] - (u[0] / state.friction + slip), state.w[1] - u[1], state.w[2] - u[2]};
    }
    products_.push_back({dot(state.r, state.w)});
  }
  gap_ = orderFreeSums<1>(products_)[0] / static_cast<double>(states_.size());
}

/// The contact's scaling and its stiffness, mass S W² D̃ S.
void InteriorPoint::scale(const Contact& contact, State& state, std::array<double, 9>& stiffness) {
  stiffness = {};
  if (contact.kind == Kind::kSpace) {
    state.size2 = kStiff;
    stiffness[0] = stiffness[4] = stiffness[8] = contact.mass * kStiff;
    return;
  }
  if (contact.kind == Kind::kInterval) {
    state.beyond = {};
    state.size2 = state.isFree ? 0 : 1 / (state.w[0] / state.r[0] + state.w[1] / state.r[1]);
    stiffness[0] = contact.mass * state.size2;
    return;
  }
  if (contact.kind == Kind::kLine) {
    state.size2 = state.r[0] / state.w[0];
    stiffness[0] = contact.mass * state.size2;
    stiffness[3] = contact.drag[0] * stiffness[0];
    stiffness[6] = contact.drag[1] * stiffness[0];
    return;
  }
  state.size2 = lorentz::scalingPoint(state.r, state.w, state.point);
  state.scaled = scaledOnce(state.point, std::sqrt(state.size2), state.w);
  const double inverse = 1 / state.friction;
  const std::array<Triple, 3> columns{
      {{inverse, 0, 0}, {state.slip[0], 1, 0}, {state.slip[1], 0, 1}}};  // of D̃ S
  for (std::size_t column = 0; column < 3; ++column) {
    const Triple y = scaledTwice(state.point, state.size2, columns[column]);
    stiffness[column] = contact.mass * inverse * y[0];
    stiffness[3 + column] = contact.mass * y[1];
    stiffness[6 + column] = contact.mass * y[2];
  }
}

/// What r becomes if u does not change: target w⁻¹ + W² residual, less the second-order term W (v \ (W⁻¹dr ∘
/// W dw)) of the predictor, where W⁻¹dr = −v − W dw. [m/s]
ContactProblem::Triple InteriorPoint::given(const Contact& contact, const State& state, double target,
                                            Order order) const {
  if (contact.kind == Kind::kSpace) {
    return {state.r[0] + state.size2 * state.residual[0], state.r[1] + state.size2 * state.residual[1],
            state.r[2] + state.size2 * state.residual[2]};
  }
  if (contact.kind == Kind::kInterval) {
    const double pull = state.isFree ? 0
                                     : (target / 2 - state.beyond[0]) / state.r[0] -
                                           (target / 2 - state.beyond[1]) / state.r[1];
    return {state.r[0] + state.size2 * (pull - (state.w[0] - state.w[1]) + state.residual[0]), 0, 0};
  }
  if (contact.kind == Kind::kLine) {
    const double product = order == Order::kSecond ? state.changeR[0] * state.changeW[0] : 0;
    return {(target - product) / state.w[0] + state.size2 * state.residual[0], 0, 0};
  }
  Triple sum = scaledTwice(state.point, state.size2, state.residual);
  const double inverse = target / determinant(state.w);
  sum[0] += inverse * state.w[0];
  sum[1] -= inverse * state.w[1];
  sum[2] -= inverse * state.w[2];
  if (order == Order::kSecond) {
    const double size = std::sqrt(state.size2);
    const Triple y = scaledOnce(state.point, size, state.changeW);
    const Triple x{-state.scaled[0] - y[0], -state.scaled[1] - y[1], -state.scaled[2] - y[2]};
    const Triple term =
        scaledOnce(state.point, size, lorentz::quotient(state.scaled, lorentz::product(x, y)));
    for (std::size_t k = 0; k < 3; ++k) {
      sum[k] -= term[k];
    }
  }
  return sum;
}

/// The changes of r and w. Of second order by those found before.
void InteriorPoint::solve(const CoupledContacts& contacts, double centering, Order order) {
  for (std::size_t c = 0; c < states_.size(); ++c) {
    const Contact& contact = contacts.contacts()[c];
    State& state = states_[c];
    if (contact.kind == Kind::kInterval && order == Order::kSecond) {
      state.beyond = {state.changeR[0] * state.changeW[0], state.changeR[1] * state.changeW[1]};
    }
    const Triple r = given(contact, state, centering * gap_, order);
    state.changeR = {r[0] - state.r[0], r[1] - state.r[1], r[2] - state.r[2]};
    answers_[c].given = impulseOf(contact, state.friction, r);
  }
  contacts.step(answers_, q_, dq_);
  for (std::size_t c = 0; c < states_.size(); ++c) {
    const Contact& contact = contacts.contacts()[c];
    State& state = states_[c];
    const Triple du = contacts.change(contact, dq_);
    if (contact.kind == Kind::kSpace) {
      for (std::size_t k = 0; k < 3; ++k) {
        state.changeR[k] -= state.size2 * du[k];
      }
      continue;
    }
    if (contact.kind == Kind::kInterval) {
      state.changeR = {state.changeR[0] - state.size2 * du[0], 0, 0};
      state.changeR[1] = -state.changeR[0];
      for (std::size_t end = 0; end < 2 && !state.isFree; ++end) {
        state.changeW[end] =
            (centering * gap_ / 2 - state.beyond[end] - state.w[end] * state.changeR[end]) / state.r[end] -
            state.w[end];
      }
      continue;
    }
    if (contact.kind == Kind::kLine) {
      state.changeW = {du[0] - state.residual[0], 0, 0};
      state.changeR[0] -= state.size2 * du[0];
      continue;
    }
    const Triple dw{du[0] / state.friction + (state.slip[0] * du[1] + state.slip[1] * du[2]), du[1], du[2]};
    const Triple answer = scaledTwice(state.point, state.size2, dw);
    for (std::size_t k = 0; k < 3; ++k) {
      state.changeW[k] = dw[k] - state.residual[k];
      state.changeR[k] -= answer[k];
    }
  }
}

double InteriorPoint::strideToSurface() const {
  double most = std::numeric_limits<double>::infinity();
  for (const State& state : states_) {
    if (state.isFree) {
      continue;
    }
    if (state.isInterval) {
      for (std::size_t end = 0; end < 2; ++end) {
        most = std::min({most, lorentz::reach({state.r[end], 0, 0}, {state.changeR[end], 0, 0}),
                         lorentz::reach({state.w[end], 0, 0}, {state.changeW[end], 0, 0})});
      }
      continue;
    }
    most = std::min({most, lorentz::reach(state.r, state.changeR), lorentz::reach(state.w, state.changeW)});
  }
  return most;
}

/// Returns whether all are in their cones.
bool InteriorPoint::move(double stride) {
  bool inside = true;
  for (State& state : states_) {
    for (std::size_t k = 0; k < 3; ++k) {
      state.r[k] += stride * state.changeR[k];
      state.w[k] += stride * state.changeW[k];
    }
    inside = inside && (!state.isInterval || state.isFree ||
                        std::min({state.r[0], state.r[1], state.w[0], state.w[1]}) > 0);
    inside = inside &&
             (state.isFree || state.isInterval ||
              (determinant(state.r) > 0 && determinant(state.w) > 0 && state.r[0] > 0 && state.w[0] > 0));
  }
  return inside;
}

bool InteriorPoint::advance(CoupledContacts& contacts) {
  for (std::size_t c = 0; c < states_.size(); ++c) {
    scale(contacts.contacts()[c], states_[c], answers_[c].stiffness);
  }
  if (!contacts.factorise(answers_)) {
    return false;
  }
  solve(contacts, 0, Order::kFirst);
  const double left = 1 - std::min(1.0, strideToSurface());
  const double centering = std::max(options_.leastCentering, left * left * left);
  solve(contacts, centering, options_.secondOrder ? Order::kSecond : Order::kFirst);
  lastStride_ = std::min(1.0, options_.stride * strideToSurface());
  if (!(lastStride_ > 0) || !move(lastStride_)) {
    return false;
  }
  refresh(contacts);
  return std::isfinite(gap_);
}

}  // namespace careen
