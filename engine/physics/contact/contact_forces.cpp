#include "physics/contact/contact_forces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/contact/lu.h"

namespace careen {
namespace {

/// ρ, as multiple of a contact's effective mass. With a heavy body on light ones each iteration multiplies
/// the residual by their mass ratio over ρ, or a power of it: if that is slow, ρ is raised.
constexpr double kPenalty = 0x1p26;
constexpr double kMorePenalty = 0x1p7;
constexpr double kMostPenalty = 0x1p46;
constexpr double kSlow = 0.125;
/// Violations this small that no longer decrease are rounding error.
constexpr double kNoise = 0x1p-46;
constexpr double kNear = 0x1p-38;
/// Conditions that contradict each other by this much are met as well as possible.
constexpr double kInconsistent = 0x1p-10;
/// [1] of the smallest violation: the iteration has diverged.
constexpr double kDiverged = 0x1p20;
/// [1] of the accelerations, with given modes: gaps and rates are projected anyway.
constexpr double kEnough = 0x1p-50;
/// [1] of the current accelerations: bodies count as not moving.
constexpr double kStands = 0x1p-40;
constexpr int kOuterCap = 40;
/// Factorisations before it counts as certain that no forces exist: then impulses do.
constexpr int kMostFactorisations = 300;

}  // namespace

void ContactForces::setBodies(std::span<const double> inverseMass) {
  problem_.inverseMass.assign(inverseMass.begin(), inverseMass.end());
  mass_.resize(inverseMass.size());
  for (std::size_t k = 0; k < mass_.size(); ++k) {
    mass_[k] = 1 / inverseMass[k];
  }
  problem_.contacts.clear();
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
  masses_.resize(contacts().size());
  for (std::size_t c = 0; c < contacts().size(); ++c) {
    const Contact& contact = contacts()[c];
    std::array<double, 3> inverseEffectiveMass{};
    const std::array<int, 2> sides{contact.a, contact.b};
    for (std::size_t side = 0; side < 2; ++side) {
      for (std::size_t k = 0; sides[side] != kNobody && k < kAxes; ++k) {
        const double inverse = problem_.inverseMass[static_cast<std::size_t>(sides[side]) * kAxes + k];
        for (std::size_t row = 0; row < 3; ++row) {
          const double value = contact.rows[row][side * kAxes + k];
          inverseEffectiveMass[row] += inverse * (value * value);
        }
      }
    }
    masses_[c] = {1 / inverseEffectiveMass[0], 2 / (inverseEffectiveMass[1] + inverseEffectiveMass[2])};
  }
}

void ContactForces::accelerate(std::span<const double> free) {
  scale_ = 0;
  excess_.resize(contacts().size());
  std::fill(a_.begin(), a_.end(), 0.0);
  for (std::size_t c = 0; c < contacts().size(); ++c) {
    push(contacts()[c], forces_[c], a_);
  }
  for (std::size_t k = 0; k < a_.size(); ++k) {
    a_[k] = free[k] + problem_.inverseMass[k] * a_[k];
  }
  for (std::size_t c = 0; c < contacts().size(); ++c) {
    for (std::size_t row = 0; row < 3; ++row) {
      const double part = along(contacts()[c], row, a_);
      excess_[c][row] = part - contacts()[c].target[row];
      scale_ = std::max(scale_, std::fabs(part) + std::fabs(contacts()[c].target[row]));
    }
    scale_ = std::max(scale_, std::fabs(forces_[c][0]) / masses_[c][0]);
  }
}

/// The mode that a force implies. A force this close to zero, or to the friction limit, counts as equal to
/// it: events are located no more accurately and would trigger again.
ContactForces::Mode ContactForces::modeOf(std::size_t c) {
  Contact& contact = contacts()[c];
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

/// Nothing moves or begins to. With redundant sticking contacts, some may be at the friction limit without
/// slipping.
bool ContactForces::stands(std::span<Mode> modes) const {
  for (std::size_t c = 0; c < contacts().size(); ++c) {
    const Force& excess = excess_[c];
    const bool pushes = modes[c] != Mode::kOff;
    if (contacts()[c].slips || (pushes && std::fabs(excess[0]) > kStands * scale_) ||
        (pushes && contacts()[c].friction > 0 &&
         std::max(std::fabs(excess[1]), std::fabs(excess[2])) > kStands * scale_)) {
      return false;
    }
  }
  for (std::size_t c = 0; c < contacts().size(); ++c) {
    modes[c] = modes[c] == Mode::kSlip ? Mode::kStick : modes[c];
  }
  return true;
}

bool ContactForces::findModes(std::span<const double> free, std::span<Mode> modes) {
  weigh();
  problem_.free.assign(free.begin(), free.end());
  solution_.impulses.clear();
  const bool solved = solver_.solve(problem_, solution_, kMostFactorisations);
  forces_ = solution_.impulses;
  a_.resize(free.size());
  accelerate(free);
  for (std::size_t c = 0; c < contacts().size(); ++c) {
    modes[c] = modeOf(c);
  }
  stands(modes);
  return solved;
}

double ContactForces::violation(std::span<const Mode> modes) const {
  double worst = 0;
  for (std::size_t c = 0; c < contacts().size(); ++c) {
    const Force& excess = excess_[c];
    if (modes[c] != Mode::kOff) {
      worst = std::max(worst, std::fabs(excess[0]));
    }
    if (modes[c] == Mode::kStick) {
      worst = std::max({worst, std::fabs(excess[1]), std::fabs(excess[2])});
    }
  }
  return worst;
}

/// −d force / d excess of the augmented Lagrangian, by rows.
std::array<double, 9> ContactForces::stiffnessOf(std::size_t c, Mode mode) const {
  std::array<double, 9> stiffness{};
  const Contact& contact = contacts()[c];
  if (mode != Mode::kOff) {
    stiffness[0] = penalty_ * masses_[c][0];
  }
  if (mode == Mode::kStick) {
    stiffness[4] = stiffness[8] = penalty_ * masses_[c][1];
  } else if (mode == Mode::kSlip) {
    stiffness[3] = -contact.friction * stiffness[0] * contact.slip[0];
    stiffness[6] = -contact.friction * stiffness[0] * contact.slip[1];
  }
  return stiffness;
}

/// M + Jᵀ D J.
void ContactForces::assemble(std::span<const Mode> modes) {
  const std::size_t axes = mass_.size();
  matrix_.assign(axes * axes, 0.0);
  for (std::size_t k = 0; k < axes; ++k) {
    matrix_[k * axes + k] = mass_[k];
  }
  for (std::size_t c = 0; c < contacts().size(); ++c) {
    if (modes[c] == Mode::kOff) {
      continue;
    }
    const Contact& contact = contacts()[c];
    const std::array<double, 9> d = stiffnessOf(c, modes[c]);
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

void ContactForces::factorise(std::span<const Mode> modes) {
  assemble(modes);
  pivots_.resize(mass_.size());
  factoriseLu(matrix_, pivots_);
}

/// One iteration of the multipliers. Returns the largest change of an acceleration at the contacts [m/s²].
double ContactForces::improve(std::span<const Mode> modes) {
  const auto respond = [&](std::size_t c, const Force& excess) {
    const std::array<double, 9> d = stiffnessOf(c, modes[c]);
    Force force = modes[c] == Mode::kOff ? Force{} : forces_[c];
    if (modes[c] == Mode::kOn) {
      force[1] = force[2] = 0;
    }
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t k = 0; k < 3; ++k) {
        force[row] -= d[3 * row + k] * excess[k];
      }
    }
    if (modes[c] == Mode::kSlip) {
      const Contact& contact = contacts()[c];
      force[1] = -contact.friction * force[0] * contact.slip[0];
      force[2] = -contact.friction * force[0] * contact.slip[1];
    }
    return force;
  };
  z_.assign(mass_.size(), 0.0);
  for (std::size_t c = 0; c < contacts().size(); ++c) {
    Force change = respond(c, excess_[c]);
    for (std::size_t row = 0; row < 3; ++row) {
      change[row] -= forces_[c][row];
    }
    push(contacts()[c], change, z_);
  }
  solveLu(matrix_, pivots_, z_);
  double most = 0;
  for (std::size_t c = 0; c < contacts().size(); ++c) {
    Force excess = excess_[c];
    for (std::size_t row = 0; row < 3; ++row) {
      const double gained = along(contacts()[c], row, z_);
      excess[row] += gained;
      most = std::max(most, std::fabs(gained));
    }
    forces_[c] = respond(c, excess);
  }
  return most;
}

bool ContactForces::solveGiven(std::span<const double> free, std::span<const Mode> modes,
                               std::span<const Force> guess) {
  weigh();
  a_.assign(free.begin(), free.end());
  forces_.assign(contacts().size(), {});
  std::copy(guess.begin(), guess.end(), forces_.begin());
  for (std::size_t c = 0; c < guess.size(); ++c) {  // the slip direction may have changed
    if (modes[c] == Mode::kSlip) {
      const Contact& contact = contacts()[c];
      forces_[c][1] = -contact.friction * forces_[c][0] * contact.slip[0];
      forces_[c][2] = -contact.friction * forces_[c][0] * contact.slip[1];
    }
  }
  penalty_ = kPenalty;
  bool factorised = false;
  double bestViolation = std::numeric_limits<double>::infinity();
  double change = bestViolation;
  int stalled = 0;
  best_.clear();
  for (int iteration = 0; iteration < kOuterCap; ++iteration) {
    accelerate(free);
    const double now = violation(modes);
    if (!(now <= kDiverged * bestViolation)) {
      break;
    }
    stalled = now < bestViolation / 2 ? 0 : stalled + 1;
    const bool good = std::min(now, bestViolation) <= kNoise * scale_;
    if (!good && now > kSlow * bestViolation && penalty_ < kMostPenalty) {
      penalty_ *= kMorePenalty;
      factorised = false;
      stalled = 0;
    }
    if (now < bestViolation) {
      bestViolation = now;
      best_ = forces_;
    }
    if (now <= kEnough * scale_ || change <= kNoise * scale_ ||
        stalled >= (bestViolation <= kNoise * scale_ ? 1 : 4)) {
      break;
    }
    if (!factorised) {
      factorise(modes);
      factorised = true;
    }
    change = improve(modes);
  }
  if (best_.size() != forces_.size()) {
    return false;
  }
  if (forces_ != best_) {
    forces_ = best_;
    accelerate(free);
  }
  return bestViolation <= kNoise * scale_ ||
         (change <= kNoise * scale_ && bestViolation <= kInconsistent * scale_);
}

}  // namespace careen
