#include "physics/contact/contact_forces.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
constexpr double kForcesDiverged = 0x1p20;
/// [1] of the accelerations, with given modes: gaps and rates are projected anyway.
constexpr double kEnough = 0x1p-50;
/// [1] of the current accelerations: bodies count as not moving.
constexpr double kStands = 0x1p-40;
constexpr int kOuterCap = 40;
/// Factorisations before it counts as certain that no forces exist: then impulses do.
constexpr int kMostFactorisations = 300;

using Admissible = ContactProblem::Admissible;

bool slips(const ContactProblem::Contact& contact) {
  return contact.admissible == Admissible::kLine ||
         (contact.admissible == Admissible::kInterval && contact.least == contact.most);
}

std::array<double, 2> dragOf(const ContactProblem::Contact& contact) {
  return {-contact.friction * contact.slip[0], -contact.friction * contact.slip[1]};
}

}  // namespace

void ContactForces::setBodies(std::span<const double> inverseMass) {
  problem_.inverseMass.assign(inverseMass.begin(), inverseMass.end());
  problem_.contacts.clear();
}

void ContactForces::set(std::span<const double> free) {
  problem_.free.assign(free.begin(), free.end());
  coupled_.set(problem_);
  const std::size_t count = contacts().size();
  multipliers_.resize(count);
  u_.resize(count);
  excess_.resize(count);
  masses_.resize(count);
  answers_.resize(count);
  q_.resize(free.size());
  dq_.resize(free.size());
  for (std::size_t c = 0; c < count; ++c) {
    masses_[coupled_.listed(c)] = coupled_.contacts()[c].mass;
  }
}

/// The accelerations that follow from the multipliers.
void ContactForces::look() {
  coupled_.velocities(multipliers_, q_);
  coupled_.relativeVelocities(q_, u_);
  scale_ = 0;
  for (std::size_t c = 0; c < u_.size(); ++c) {
    const CoupledContacts::Contact& contact = coupled_.contacts()[c];
    for (std::size_t row = 0; row < 3; ++row) {
      const double target = contact.target[row];
      scale_ = std::max(scale_, std::fabs(u_[c][row] + target) + std::fabs(target));
    }
    scale_ = std::max(scale_, std::fabs(multipliers_[c][0]) / contact.mass);
    excess_[coupled_.listed(c)] = u_[c];
  }
  coupled_.exportVelocities(q_, a_);
  coupled_.exportImpulses(multipliers_, forces_);
}

/// The mode that a force implies. A force this close to zero, or to the friction limit, counts as equal to
/// it: events are located no more accurately and would trigger again.
ContactForces::Mode ContactForces::modeOf(std::size_t c) {
  Contact& contact = contacts()[c];
  const Force& force = forces_[c];
  if (contact.admissible == Admissible::kSpace) {
    return Mode::kStick;
  }
  if (contact.admissible == Admissible::kInterval) {
    const double near = kNear * (contact.most - contact.least);
    return force[0] > contact.least + near && force[0] < contact.most - near ? Mode::kStick : Mode::kSlip;
  }
  if (force[0] <= kNear * scale_ * masses_[c]) {
    return Mode::kOff;
  }
  if (contact.friction <= 0) {
    return Mode::kOn;
  }
  const double size = std::sqrt(force[1] * force[1] + force[2] * force[2]);
  if (!slips(contact) && size < (1 - kNear) * contact.friction * force[0]) {
    return Mode::kStick;
  }
  if (!slips(contact)) {
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
    if (slips(contacts()[c]) || (pushes && std::fabs(excess[0]) > kStands * scale_) ||
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
  set(free);
  solution_.impulses.clear();
  const bool solved = solver_.solve(problem_, solution_, kMostFactorisations);
  coupled_.importImpulses(solution_.impulses, multipliers_);
  look();
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
    const bool isGiven = contacts()[c].admissible == Admissible::kInterval && modes[c] == Mode::kSlip;
    if (modes[c] != Mode::kOff && !isGiven) {
      worst = std::max(worst, std::fabs(excess[0]));
    }
    if (modes[c] == Mode::kStick) {
      worst = std::max({worst, std::fabs(excess[1]), std::fabs(excess[2])});
    }
  }
  return worst;
}

/// How the multipliers follow the accelerations.
void ContactForces::answer(std::span<const Mode> modes) {
  for (std::size_t c = 0; c < answers_.size(); ++c) {
    const CoupledContacts::Contact& contact = coupled_.contacts()[c];
    const Mode mode = modes[coupled_.listed(c)];
    if (mode == Mode::kOff) {
      answers_[c] = {};
      continue;
    }
    ImpulseSet law{.mass = contact.mass,
                   .kind = mode == Mode::kStick ? ImpulseSet::Kind::kCone : ImpulseSet::Kind::kLine};
    if (mode == Mode::kSlip && contact.isGiven()) {
      law = contact;
    } else if (mode == Mode::kSlip) {
      law.drag = dragOf(contacts()[coupled_.listed(c)]);
    }
    answers_[c] = stickingAnswer(law, {.rho = penalty_ * law.mass, .epsilon = 1}, multipliers_[c], u_[c]);
  }
}

/// One iteration of the multipliers. Returns the largest change of an acceleration at the contacts [m/s²].
double ContactForces::improve() {
  coupled_.step(answers_, q_, dq_);
  double most = 0;
  for (std::size_t c = 0; c < answers_.size(); ++c) {
    for (const double gained : coupled_.change(coupled_.contacts()[c], dq_)) {
      most = std::max(most, std::fabs(gained));
    }
    multipliers_[c] = coupled_.answerTo(c, answers_[c], dq_);
  }
  return most;
}

bool ContactForces::solveGiven(std::span<const double> free, std::span<const Mode> modes,
                               std::span<const Force> guess) {
  set(free);
  std::fill(multipliers_.begin(), multipliers_.end(), Force{});
  if (!guess.empty()) {
    coupled_.importImpulses(guess, multipliers_);
  }
  for (std::size_t c = 0; c < multipliers_.size(); ++c) {  // the slip direction may have changed
    if (modes[coupled_.listed(c)] == Mode::kSlip) {
      const auto drag = dragOf(contacts()[coupled_.listed(c)]);
      Force& force = multipliers_[c];
      force = coupled_.contacts()[c].isGiven() ? Force{coupled_.contacts()[c].least, 0, 0}
                                               : Force{force[0], drag[0] * force[0], drag[1] * force[0]};
    }
  }
  penalty_ = kPenalty;
  bool factorised = false;
  double bestViolation = std::numeric_limits<double>::infinity();
  double change = bestViolation;
  int stalled = 0;
  best_.clear();
  for (int iteration = 0; iteration < kOuterCap; ++iteration) {
    look();
    const double now = violation(modes);
    if (!(now <= kForcesDiverged * bestViolation)) {
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
      best_ = multipliers_;
    }
    if (now <= kEnough * scale_ || change <= kNoise * scale_ ||
        stalled >= (bestViolation <= kNoise * scale_ ? 1 : 4)) {
      break;
    }
    answer(modes);
    if (!factorised && !coupled_.factorise(answers_)) {
      break;
    }
    factorised = true;
    turned_ = coupled_.isNegative();
    change = improve();
  }
  if (best_.size() != multipliers_.size()) {
    return false;
  }
  if (multipliers_ != best_) {
    multipliers_ = best_;
    look();
  }
  return bestViolation <= kNoise * scale_ ||
         (change <= kNoise * scale_ && bestViolation <= kInconsistent * scale_);
}

}  // namespace careen
