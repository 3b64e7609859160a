#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <utility>

#include "physics/contact/contact_forces.h"
#include "physics/impact/impact_solver.h"
#include "physics/impact/secant_iteration.h"

namespace careen {
namespace {

constexpr int kMostLimits = 40;
/// Iterations of the limits between attempts of Newton's method.
constexpr int kTryEvery = 4;
/// [1] of the largest force: accuracy of forces from unfinished iterations of the limits.
constexpr double kRough = 0x1p-16;
constexpr double kLimitsAccuracy = 0x1p-46;
constexpr int kMostDecisions = 8;
/// [1] of the current accelerations: contact conditions count as met, and bodies as not moving.
constexpr double kDecided = 0x1p-36;
constexpr double kStands = 0x1p-40;

}  // namespace

/// Where Newton's method fails: friction limits are guessed, which leaves a convex problem, and made to agree
/// with the normal forces by iteration. Every few iterations Newton's method is tried from there.
ContactForces::Limits ContactForces::solveByLimits(std::span<const double> free, std::span<Mode> modes,
                                                   double agreement, double enough) {
  ImpactVector<ImpactSolver::Contact> contacts;
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    contacts.push_back({.a = contacts_[c].a,
                        .b = contacts_[c].b,
                        .rows = contacts_[c].rows,
                        .normalMass = masses_[c][0],
                        .tangentialMass = masses_[c][1]});
  }
  ImpactSolver solver(ImpactVector<double>(inverseMass_.begin(), inverseMass_.end()), std::move(contacts));
  ImpactVector<ImpactSolver::Demand> demands(contacts_.size());
  ImpactVector<ImpactSolver::Impulse> impulses(contacts_.size());
  ImpactVector<double> limits(contacts_.size(), 0.0);
  ImpactVector<double> found(contacts_.size(), 0.0);
  SecantIteration iteration(contacts_.size(), std::pmr::get_default_resource());
  bool agrees = false;
  for (int k = 0; k < kMostLimits && !agrees; ++k) {
    std::fill(a_.begin(), a_.end(), 0.0);
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      const Contact& contact = contacts_[c];
      demands[c] = {.partingSpeed = contact.target[0],
                    .frictionLimit = contact.slips ? 0 : limits[c],
                    .slip = {contact.target[1], contact.target[2]}};
      if (contact.slips) {
        push(contact, {0, -limits[c] * contact.slip[0], -limits[c] * contact.slip[1]}, a_);
      }
    }
    for (std::size_t i = 0; i < a_.size(); ++i) {
      a_[i] = free[i] + inverseMass_[i] * a_[i];
    }
    solver.solve(a_, demands, impulses, kLimitsAccuracy);
    double change = 0;
    double largest = 0;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      found[c] = contacts_[c].friction * impulses[c][0];
      change = std::max(change, std::fabs(found[c] - limits[c]));
      largest = std::max(largest, std::max(found[c], limits[c]));
    }
    agrees = change <= agreement * largest;
    if (!agrees && k % kTryEvery == kTryEvery - 1) {
      std::vector<Force> guess(impulses.begin(), impulses.end());
      for (std::size_t c = 0; c < contacts_.size(); ++c) {
        if (contacts_[c].slips) {
          guess[c][1] = -found[c] * contacts_[c].slip[0];
          guess[c][2] = -found[c] * contacts_[c].slip[1];
        }
      }
      if (solveByNewton(free, modes, Modes::kFound, guess, modesNear(guess), enough)) {
        return Limits::kSolved;
      }
    }
    iteration.step(limits, found, k < kMostLimits / 4 ? 1 : 0.5);
    for (double& limit : limits) {
      limit = std::max(0.0, limit);
    }
  }
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    forces_[c] = impulses[c];
    if (contacts_[c].slips) {
      forces_[c][1] = -limits[c] * contacts_[c].slip[0];
      forces_[c][2] = -limits[c] * contacts_[c].slip[1];
    }
    modes[c] = contacts_[c].slips && forces_[c][0] > 0 ? Mode::kSlip : modeOf(c);
  }
  accelerate(free);
  return agrees ? Limits::kAgree : Limits::kDisagree;
}

/// The likely modes, given approximate forces.
std::vector<ContactForces::Mode> ContactForces::modesNear(std::span<const Force> forces) const {
  double most = 0;
  for (const Force& force : forces) {
    most = std::max(most, force[0]);
  }
  std::vector<Mode> modes;
  for (std::size_t c = 0; c < forces.size(); ++c) {
    const Force& force = forces[c];
    const double limit = contacts_[c].friction * force[0];
    if (force[0] <= kRough * most) {
      modes.push_back(Mode::kOff);
    } else if (limit <= 0) {
      modes.push_back(Mode::kOn);
    } else {
      const double size = std::sqrt(force[1] * force[1] + force[2] * force[2]);
      modes.push_back(contacts_[c].slips || size >= (1 - kRough) * limit ? Mode::kSlip : Mode::kStick);
    }
  }
  return modes;
}

/// Nothing moves or begins to. With redundant sticking contacts, some may be at the friction limit without
/// slipping.
bool ContactForces::stands(std::span<Mode> modes) const {
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const Force& excess = excess_[c];
    const bool pushes = modes[c] != Mode::kOff;
    if (contacts_[c].slips || (pushes && std::fabs(excess[0]) > kStands * scale_) ||
        (pushes && contacts_[c].friction > 0 &&
         std::max(std::fabs(excess[1]), std::fabs(excess[2])) > kStands * scale_)) {
      return false;
    }
  }
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    modes[c] = modes[c] == Mode::kSlip ? Mode::kStick : modes[c];
  }
  return true;
}

/// Modes that the iteration left undecided are decided in favour of slip and separation.
bool ContactForces::decide(std::span<const double> free, std::span<Mode> modes) {
  for (int k = 0; k < kMostDecisions; ++k) {
    if (!solveByNewton(free, modes, Modes::kGiven, {}, {}, kRounding)) {
      return false;
    }
    bool same = true;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      const bool goesOn = modes[c] == Mode::kOff || (modes[c] == Mode::kSlip && forces_[c][0] > 0);
      const Mode now = goesOn ? modes[c] : modeOf(c);
      same = same && now == modes[c];
      modes[c] = now;
    }
    if (same) {
      return violation(modes, Modes::kFound) <= kDecided * scale_;
    }
  }
  return false;
}

}  // namespace careen
