#include "physics/contact/contact_forces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "physics/contact/lu.h"

namespace careen {
namespace {

/// ρ, as multiple of a contact's effective mass: see ImpactSolver. With a heavy body on light ones each
/// iteration multiplies the residual by their mass ratio over ρ, or a power of it: if that is slow, ρ is
/// raised.
constexpr double kPenalty = 0x1p26;
constexpr double kMorePenalty = 0x1p7;
constexpr double kMostPenalty = 0x1p46;
constexpr double kSlow = 0.125;
/// Violations this small that no longer decrease are rounding error.
constexpr double kNoise = 0x1p-46;
constexpr double kNear = 0x1p-38;
/// Conditions that contradict each other by this much are met as well as possible.
constexpr double kInconsistent = 0x1p-10;
/// [1] of the smallest violation: Newton's method has diverged.
constexpr double kDiverged = 0x1p20;
/// [1] of the largest friction limit.
constexpr double kLimitsAgree = 0x1p-42;
constexpr double kImpulsesAgree = 0x1p-16;
/// [1] of the velocities: the error of a time step is larger.
constexpr double kImpulsesEnough = 0x1p-30;
/// [1] of the accelerations, with given modes: gaps and rates are projected anyway.
constexpr double kGivenEnough = 0x1p-50;
constexpr int kOuterCap = 40;
constexpr int kInnerCap = 40;
/// Full Newton steps before half steps are tried, to break cycles.
constexpr int kFullSteps = 12;

bool isSame(const std::array<double, 9>& x, const std::array<double, 9>& y, double within) {
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (std::fabs(x[k] - y[k]) > within) {
      return false;
    }
  }
  return true;
}

}  // namespace

void ContactForces::setBodies(std::span<const double> inverseMass) {
  inverseMass_.assign(inverseMass.begin(), inverseMass.end());
  mass_.resize(inverseMass_.size());
  for (std::size_t k = 0; k < mass_.size(); ++k) {
    mass_[k] = 1 / inverseMass_[k];
  }
  contacts_.clear();
}

double ContactForces::along(const Contact& contact, std::size_t row, std::span<const double> of) const {
  const Row& values = contact.rows[row];
  double sum = 0;
  if (contact.a != kNobody) {
    const double* part = &of[static_cast<std::size_t>(contact.a) * kAxes];
    for (std::size_t k = 0; k < kAxes; ++k) {
      sum += values[k] * part[k];
    }
  }
  if (contact.b != kNobody) {
    const double* part = &of[static_cast<std::size_t>(contact.b) * kAxes];
    for (std::size_t k = 0; k < kAxes; ++k) {
      sum += values[kAxes + k] * part[k];
    }
  }
  return sum;
}

void ContactForces::push(const Contact& contact, const Force& force, std::span<double> onto) const {
  const auto& [n, t, u] = contact.rows;
  const std::array<int, 2> sides{contact.a, contact.b};
  for (std::size_t side = 0; side < 2; ++side) {
    if (sides[side] != kNobody) {
      double* part = &onto[static_cast<std::size_t>(sides[side]) * kAxes];
      for (std::size_t k = 0; k < kAxes; ++k) {
        const std::size_t i = side * kAxes + k;
        part[k] += n[i] * force[0] + t[i] * force[1] + u[i] * force[2];
      }
    }
  }
}

void ContactForces::weigh() {
  masses_.resize(contacts_.size());
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const Contact& contact = contacts_[c];
    std::array<double, 3> inverseEffectiveMass{};
    const std::array<int, 2> sides{contact.a, contact.b};
    for (std::size_t side = 0; side < 2; ++side) {
      for (std::size_t k = 0; sides[side] != kNobody && k < kAxes; ++k) {
        const double inverse = inverseMass_[static_cast<std::size_t>(sides[side]) * kAxes + k];
        for (std::size_t row = 0; row < 3; ++row) {
          const double value = contact.rows[row][side * kAxes + k];
          inverseEffectiveMass[row] += inverse * (value * value);
        }
      }
    }
    masses_[c] = {1 / inverseEffectiveMass[0], 2 / (inverseEffectiveMass[1] + inverseEffectiveMass[2])};
  }
}

/// The force of the augmented Lagrangian: the multiplier minus penalty times excess, projected onto the
/// admissible set; and its derivative with respect to the excess.
ContactForces::Response ContactForces::respond(std::size_t c, const Force& excess, const Mode* as,
                                               Modes how) const {
  const Contact& contact = contacts_[c];
  const Force& guess = forces_[c];
  const double stiff = penalty_ * masses_[c][0];
  const double stiffTangent = penalty_ * masses_[c][1];
  Response response;
  const double normal = guess[0] - stiff * excess[0];
  if (as != nullptr ? *as == Mode::kOff : normal <= 0) {
    return response;
  }
  response.mode = Mode::kOn;
  response.force[0] = normal;
  response.stiffness[0] = stiff;
  const double mu = contact.friction;
  if (as != nullptr ? *as == Mode::kOn : mu <= 0) {
    return response;
  }
  if (contact.slips ? as == nullptr || *as == Mode::kSlip : how == Modes::kGiven && *as == Mode::kSlip) {
    response.mode = Mode::kSlip;
    for (std::size_t k = 0; k < 2; ++k) {
      response.force[1 + k] = -mu * normal * contact.slip[k];
      response.stiffness[3 + 3 * k] = -mu * stiff * contact.slip[k];
    }
    return response;
  }
  const double x = guess[1] - stiffTangent * excess[1];
  const double y = guess[2] - stiffTangent * excess[2];
  const double size = std::sqrt(x * x + y * y);
  const double limit = mu * normal;
  // Without a tangential force there is no direction in which slip could begin.
  if (size == 0 || (as != nullptr ? *as == Mode::kStick : size <= limit)) {
    response.mode = Mode::kStick;
    response.force[1] = x;
    response.force[2] = y;
    response.stiffness[4] = stiffTangent;
    response.stiffness[8] = stiffTangent;
    return response;
  }
  response.mode = Mode::kSlip;
  const std::array<double, 2> to{x / size, y / size};
  const double turn = stiffTangent * limit / size;
  response.force[1] = limit * to[0];
  response.force[2] = limit * to[1];
  response.stiffness[3] = mu * stiff * to[0];
  response.stiffness[6] = mu * stiff * to[1];
  response.stiffness[4] = turn * (to[1] * to[1]);
  response.stiffness[5] = -turn * (to[0] * to[1]);
  response.stiffness[7] = response.stiffness[5];
  response.stiffness[8] = turn * (to[0] * to[0]);
  return response;
}

void ContactForces::accelerate(std::span<const double> free) {
  scale_ = 0;
  std::fill(a_.begin(), a_.end(), 0.0);
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    push(contacts_[c], forces_[c], a_);
  }
  for (std::size_t k = 0; k < a_.size(); ++k) {
    a_[k] = free[k] + inverseMass_[k] * a_[k];
  }
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    for (std::size_t row = 0; row < 3; ++row) {
      const double part = along(contacts_[c], row, a_);
      excess_[c][row] = part - contacts_[c].target[row];
      scale_ = std::max(scale_, std::fabs(part) + std::fabs(contacts_[c].target[row]));
    }
    scale_ = std::max(scale_, std::fabs(forces_[c][0]) / masses_[c][0]);
  }
}

double ContactForces::violation(std::span<const Mode> modes, Modes how) const {
  double worst = 0;
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const Force& excess = excess_[c];
    const Force& force = forces_[c];
    if (how == Modes::kGiven) {
      if (modes[c] != Mode::kOff) {
        worst = std::max(worst, std::fabs(excess[0]));
      }
      if (modes[c] == Mode::kStick) {
        worst = std::max({worst, std::fabs(excess[1]), std::fabs(excess[2])});
      }
      continue;
    }
    const auto& [normalMass, tangentialMass] = masses_[c];
    worst = std::max(worst, std::fabs(std::min(excess[0], force[0] / normalMass)));
    if (contacts_[c].friction > 0 && !contacts_[c].slips) {
      const double x = force[1] - tangentialMass * excess[1];
      const double y = force[2] - tangentialMass * excess[2];
      const double size = std::sqrt(x * x + y * y);
      const double limit = contacts_[c].friction * std::max(0.0, force[0]);
      const double shrink = size > limit ? limit / size : 1;
      worst = std::max({worst, std::fabs(force[1] - shrink * x) / tangentialMass,
                        std::fabs(force[2] - shrink * y) / tangentialMass});
    }
  }
  return worst;
}

/// M + Jᵀ D J.
void ContactForces::assemble() {
  const std::size_t axes = mass_.size();
  std::fill(matrix_.begin(), matrix_.end(), 0.0);
  for (std::size_t k = 0; k < axes; ++k) {
    matrix_[k * axes + k] = mass_[k];
  }
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const Response& response = responses_[c];
    if (response.mode == Mode::kOff) {
      continue;
    }
    const Contact& contact = contacts_[c];
    const auto& d = response.stiffness;
    const auto& [n, t, u] = contact.rows;
    std::array<Row, 3> stiff{};  // D J
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t k = 0; k < 2 * kAxes; ++k) {
        stiff[row][k] = d[3 * row] * n[k] + d[3 * row + 1] * t[k] + d[3 * row + 2] * u[k];
      }
    }
    const std::array<int, 2> sides{contact.a, contact.b};
    for (std::size_t from = 0; from < 2; ++from) {
      for (std::size_t to = 0; to < 2; ++to) {
        if (sides[from] == kNobody || sides[to] == kNobody) {
          continue;
        }
        const std::size_t top = static_cast<std::size_t>(sides[from]) * kAxes;
        const std::size_t left = static_cast<std::size_t>(sides[to]) * kAxes;
        for (std::size_t i = 0; i < kAxes; ++i) {
          double* row = &matrix_[(top + i) * axes + left];
          const std::size_t k = from * kAxes + i;
          const double* s0 = &stiff[0][to * kAxes];
          const double* s1 = &stiff[1][to * kAxes];
          const double* s2 = &stiff[2][to * kAxes];
          for (std::size_t j = 0; j < kAxes; ++j) {
            row[j] += n[k] * s0[j] + t[k] * s1[j] + u[k] * s2[j];
          }
        }
      }
    }
  }
}

/// Solves for the responses at the current multipliers and leaves them in responses_. Returns the largest
/// change of an acceleration at the contacts [m/s²].
double ContactForces::newton(std::span<const Mode> modes, Modes how) {
  std::fill(z_.begin(), z_.end(), 0.0);
  std::fill(gained_.begin(), gained_.end(), Force{});
  const auto respondAll = [&](bool asBefore) {
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      Force excess = excess_[c];
      for (std::size_t row = 0; row < 3; ++row) {
        excess[row] += gained_[c][row];
      }
      const Mode* as = how == Modes::kGiven ? &modes[c] : asBefore ? &factorised_[c].mode : nullptr;
      responses_[c] = respond(c, excess, as, how);
    }
  };
  // Contacts active at the last multipliers likely stay active: rounding error times the penalty must not
  // decide.
  respondAll(factorised_.size() == contacts_.size());
  cycles_ = true;
  for (int iteration = 0; iteration < kInnerCap; ++iteration) {
    std::fill(gradient_.begin(), gradient_.end(), 0.0);
    bool known = factorised_.size() == responses_.size();
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      const Response& response = responses_[c];
      Force change = response.force;
      for (std::size_t row = 0; row < 3; ++row) {
        change[row] -= forces_[c][row];
      }
      push(contacts_[c], change, gradient_);
      known = known && factorised_[c].mode == response.mode &&
              isSame(factorised_[c].stiffness, response.stiffness, 0x1p-26 * penalty_ * masses_[c][0]);
    }
    for (std::size_t k = 0; k < z_.size(); ++k) {
      gradient_[k] -= mass_[k] * z_[k];
    }
    if (!known) {
      assemble();
      factoriseLu(matrix_, pivots_);
      factorised_ = responses_;
    }
    solveLu(matrix_, pivots_, gradient_);
    const double length = iteration < kFullSteps ? 1 : 0.5;
    double moved = 0;
    double size = 0;
    for (std::size_t k = 0; k < z_.size(); ++k) {
      z_[k] += length * gradient_[k];
      moved += mass_[k] * gradient_[k] * gradient_[k];
      size += mass_[k] * z_[k] * z_[k];
    }
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      for (std::size_t row = 0; row < 3; ++row) {
        gained_[c][row] = along(contacts_[c], row, z_);
      }
    }
    respondAll(false);
    if (how == Modes::kGiven) {
      cycles_ = false;
      break;
    }
    bool same = length == 1 || moved <= 0x1p-60 * size;
    bool begins = false;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      same = same && responses_[c].mode == factorised_[c].mode;
      begins = begins || (responses_[c].mode == Mode::kSlip && !contacts_[c].slips);
    }
    if (same && (!begins || moved <= 0x1p-60 * size)) {
      cycles_ = false;
      break;
    }
  }
  double change = 0;
  for (const Force& gained : gained_) {
    for (const double part : gained) {
      change = std::max(change, std::fabs(part));
    }
  }
  return change;
}

/// The mode that a force implies. A force this close to zero, or to the friction limit, counts as equal to
/// it: events are located no more accurately and would trigger again.
ContactForces::Mode ContactForces::modeOf(std::size_t c) {
  Contact& contact = contacts_[c];
  const Force& force = forces_[c];
  if (force[0] <= kNear * scale_ * masses_[c][0]) {
    return Mode::kOff;
  }
  if (contact.friction <= 0) {
    return Mode::kOn;
  }
  const double size = std::sqrt(force[1] * force[1] + force[2] * force[2]);
  if (!contact.slips && size < (1 - kNear) * contact.friction * force[0]) {
    return Mode::kStick;
  }
  if (!contact.slips) {
    contact.slip = {-force[1] / size, -force[2] / size};
  }
  return Mode::kSlip;
}

bool ContactForces::solve(std::span<const double> free, std::span<Mode> modes, Modes how,
                          std::span<const Force> guess) {
  if (solveByNewton(free, modes, how, guess, {}, how == Modes::kGiven ? kGivenEnough : kRounding)) {
    return true;
  }
  if (how == Modes::kGiven) {
    return false;
  }
  const Limits limits = solveByLimits(free, modes, kLimitsAgree, kRounding);
  return limits == Limits::kSolved || (limits == Limits::kAgree && (stands(modes) || decide(free, modes)));
}

void ContactForces::solveImpulses(std::span<const double> free, std::span<Mode> modes) {
  if (!solveByNewton(free, modes, Modes::kFound, {}, {}, kImpulsesEnough)) {
    solveByLimits(free, modes, kImpulsesAgree, kImpulsesEnough);
  }
}

// `first`: the initial modes; `enough`: the violation to stop at, [1] of the accelerations.
bool ContactForces::solveByNewton(std::span<const double> free, std::span<Mode> modes, Modes how,
                                  std::span<const Force> guess, std::span<const Mode> first, double enough) {
  const std::size_t axes = mass_.size();
  weigh();
  a_.assign(free.begin(), free.end());
  forces_.assign(contacts_.size(), {});
  std::copy(guess.begin(), guess.end(), forces_.begin());
  for (std::size_t c = 0; c < guess.size(); ++c) {  // the slip direction may have changed
    if (how == Modes::kGiven && modes[c] == Mode::kSlip) {
      const Contact& contact = contacts_[c];
      forces_[c][1] = -contact.friction * forces_[c][0] * contact.slip[0];
      forces_[c][2] = -contact.friction * forces_[c][0] * contact.slip[1];
    }
  }
  excess_.assign(contacts_.size(), {});
  gained_.assign(contacts_.size(), {});
  responses_.assign(contacts_.size(), {});
  factorised_.assign(first.size(), {});
  for (std::size_t c = 0; c < first.size(); ++c) {
    factorised_[c].mode = first[c];
  }
  z_.resize(axes);
  gradient_.resize(axes);
  matrix_.resize(axes * axes);
  pivots_.resize(axes);
  penalty_ = kPenalty;
  cycles_ = false;
  double bestViolation = std::numeric_limits<double>::infinity();
  double change = bestViolation;
  int stalled = 0;
  for (int iteration = 0; iteration < kOuterCap; ++iteration) {
    accelerate(free);
    const double now = violation(modes, how);
    if (!(now <= kDiverged * bestViolation)) {
      break;
    }
    if (cycles_ && now > bestViolation / 2) {
      break;
    }
    stalled = now < bestViolation / 2 ? 0 : stalled + 1;
    const bool good = std::min(now, bestViolation) <= kNoise * scale_;
    if (!good && now > kSlow * bestViolation && penalty_ < kMostPenalty) {
      penalty_ *= kMorePenalty;
      stalled = 0;
    }
    if (now < bestViolation) {
      bestViolation = now;
      best_ = forces_;
    }
    const bool settled = how == Modes::kGiven && change <= kNoise * scale_;
    if (now <= enough * scale_ || settled || stalled >= (bestViolation <= kNoise * scale_ ? 1 : 4)) {
      break;
    }
    change = newton(modes, how);
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      forces_[c] = responses_[c].force;
    }
  }
  if (best_.size() != forces_.size()) {
    return false;
  }
  if (forces_ != best_) {
    forces_ = best_;
    accelerate(free);
  }
  if (how == Modes::kFound) {
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      modes[c] = modeOf(c);
    }
  }
  return bestViolation <= std::max(kNoise, enough) * scale_ ||
         (how == Modes::kGiven && change <= kNoise * scale_ && bestViolation <= kInconsistent * scale_);
}

}  // namespace careen
