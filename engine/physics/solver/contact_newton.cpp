#include "physics/solver/contact_newton.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace careen {
namespace {

using Contact = CoupledContacts::Contact;

constexpr int kPatience = 3;
/// [1] ε stays in this range.
constexpr double kLeastEpsilon = 0x1p-26;
constexpr double kMostEpsilon = 1;
constexpr double kWideSpread = 0x1p20;  // beyond, ε has to be smaller, or the heavy hardly moves
/// [1] of V: beyond, the iteration has diverged, and would overflow.
constexpr double kDiverged = 0x1p100;
/// A proximal point is found if its equations hold to so much of the last residual, within so many steps; it
/// is given up if any step from the third on leaves a larger error than the first.
constexpr double kProximal = 0.3;
constexpr int kProximalSteps = 6;
constexpr int kProximalTrials = 3;
constexpr double kRetreat = 16;  // [1] of ε, after one that was not found
/// [1] Of the largest λ/mass.
constexpr double kGhost = 1e-3;

ContactEquation equationOf(const Contact& contact, const ContactNewton::Options& options) {
  return {.rho = options.rho * contact.mass, .epsilon = options.epsilon};
}

/// No number is worst of all, and stays.
double worseOf(double worst, double error) { return std::isnan(worst) || error <= worst ? worst : error; }

}  // namespace

double ContactNewton::residual(const CoupledContacts& contacts, std::span<const Triple> impulses,
                               std::span<double> q) {
  contacts.velocities(impulses, q);
  double worst = 0;
  for (std::size_t c = 0; c < impulses.size(); ++c) {
    const Contact& contact = contacts.contacts()[c];
    worst = worseOf(worst, contact.violation(impulses[c], contacts.relativeVelocity(contact, q)));
  }
  return worst;
}

bool ContactNewton::isGood(const CoupledContacts& contacts, std::span<const Triple> impulses, double residual,
                           double good) {
  return residual <= good && residual <= kGhost * contacts.largest(impulses);
}

/// Brings the impulses into their cones; the residual of that.
double ContactNewton::begin(const CoupledContacts& contacts, std::span<Triple> impulses,
                            std::span<double> q) {
  const std::size_t count = impulses.size();
  impulses_.resize(count);
  admissible_.resize(count);
  u_.resize(count);
  answers_.resize(count);
  q_.resize(q.size());
  dq_.resize(q.size());
  admissibleQ_.resize(q.size());
  factorisations_ = 0;
  for (std::size_t c = 0; c < count; ++c) {
    impulses_[c] = contacts.contacts()[c].admissible(impulses[c]);
  }
  follow(contacts);
  std::copy(impulses_.begin(), impulses_.end(), impulses.begin());
  std::copy(q_.begin(), q_.end(), q.begin());
  double worst = 0;
  for (std::size_t c = 0; c < count; ++c) {
    worst = worseOf(worst, contacts.contacts()[c].violation(impulses_[c], u_[c]));
  }
  return worst;
}

/// The velocities that follow from impulses_.
void ContactNewton::follow(const CoupledContacts& contacts) {
  contacts.velocities(impulses_, q_);
  contacts.relativeVelocities(q_, u_);
}

/// Moves impulses_ by one full step. Returns false if that leads nowhere.
bool ContactNewton::step(CoupledContacts& contacts, const Options& options, std::span<const Triple> centres,
                         Modes modes) {
  for (std::size_t c = 0; c < impulses_.size(); ++c) {
    const Contact& contact = contacts.contacts()[c];
    const ContactEquation equation = equationOf(contact, options);
    answers_[c] = modes == Modes::kSticking
                      ? stickingAnswer(contact, equation, centres[c], u_[c])
                      : newtonAnswer(contact, equation, impulses_[c], centres[c], u_[c]);
  }
  ++factorisations_;
  if (!contacts.factorise(answers_)) {
    return false;
  }
  contacts.step(answers_, q_, dq_);
  double largest = 0;
  for (std::size_t c = 0; c < impulses_.size(); ++c) {
    impulses_[c] = contacts.answerTo(c, answers_[c], dq_);
    for (const double part : impulses_[c]) {
      largest = std::max(largest, std::fabs(part) / contacts.contacts()[c].mass);
    }
  }
  follow(contacts);
  return largest <= kDiverged * contacts.scale();
}

/// Residual of impulses_ brought into their cones.
double ContactNewton::admit(const CoupledContacts& contacts) {
  for (std::size_t c = 0; c < impulses_.size(); ++c) {
    admissible_[c] = contacts.contacts()[c].admissible(impulses_[c]);
  }
  return residual(contacts, admissible_, admissibleQ_);
}

void ContactNewton::keep(std::span<Triple> impulses, std::span<double> q) const {
  std::copy(admissible_.begin(), admissible_.end(), impulses.begin());
  std::copy(admissibleQ_.begin(), admissibleQ_.end(), q.begin());
}

double ContactNewton::improve(CoupledContacts& contacts, std::span<Triple> impulses, std::span<double> q,
                              const Options& options) {
  double best = begin(contacts, impulses, q);
  int stalled = 0;
  while (factorisations_ < options.steps && best > options.enough && stalled < kPatience &&
         !isGood(contacts, impulses, best, options.good)) {
    if (!step(contacts, options, impulses_,
              options.sticking && factorisations_ == 0 ? Modes::kSticking : Modes::kOfImpulses)) {
      break;
    }
    const double now = admit(contacts);
    if (!(now <= kDiverged * contacts.scale())) {
      break;
    }
    stalled = now < best / 2 ? 0 : stalled + 1;
    if (now < best) {
      best = now;
      keep(impulses, q);
    }
  }
  return best;
}

/// Of impulses_, with centres_.
double ContactNewton::equationsError(const CoupledContacts& contacts, const Options& options) const {
  double worst = 0;
  for (std::size_t c = 0; c < impulses_.size(); ++c) {
    const Contact& contact = contacts.contacts()[c];
    worst = worseOf(worst,
                    equationError(contact, equationOf(contact, options), impulses_[c], centres_[c], u_[c]));
  }
  return worst;
}

/// From centres_. `wanted` [m/s]: how well the equations have to hold.
bool ContactNewton::solveProximal(CoupledContacts& contacts, const Options& options, double wanted,
                                  int& steps) {
  if (impulses_ != centres_) {
    std::copy(centres_.begin(), centres_.end(), impulses_.begin());
    follow(contacts);
  }
  double most = kDiverged * contacts.scale();
  for (steps = 1; steps <= kProximalSteps && factorisations_ < options.steps; ++steps) {
    if (!step(contacts, options, centres_, Modes::kOfImpulses)) {
      return false;
    }
    const double error = equationsError(contacts, options);
    if (error <= wanted) {
      return true;
    }
    if (steps == 1) {
      most = std::min(most, error);
    }
    if (!(error <= most) && steps >= kProximalTrials) {
      return false;
    }
  }
  return false;
}

double ContactNewton::approach(CoupledContacts& contacts, std::span<Triple> impulses, std::span<double> q,
                               Options options) {
  double best = begin(contacts, impulses, q);
  centres_.assign(impulses.begin(), impulses.end());
  const double leastEpsilon = kLeastEpsilon / std::max(1.0, contacts.spread() / kWideSpread);
  double now = best;
  double halved = best;
  int lastHalved = 0;
  while (factorisations_ < options.steps && best > options.enough && options.epsilon < kMostEpsilon &&
         factorisations_ - lastHalved <= options.patience &&
         !isGood(contacts, impulses, best, options.good)) {
    int steps = 0;
    if (!solveProximal(contacts, options, std::max(kProximal * now, options.enough), steps)) {
      options.epsilon *= kRetreat;
      continue;
    }
    std::copy(impulses_.begin(), impulses_.end(), centres_.begin());
    now = admit(contacts);
    if (now < best) {
      best = now;
      keep(impulses, q);
    }
    if (best < halved / 2) {
      halved = best;
      lastHalved = factorisations_;
    }
    options.epsilon = std::max(leastEpsilon, options.epsilon / (steps <= 2               ? 8
                                                                : steps < kProximalSteps ? 2
                                                                                         : 1));
  }
  return best;
}

}  // namespace careen
