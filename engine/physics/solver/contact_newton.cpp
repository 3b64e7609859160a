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
/// [1] A descending step is worth taking if it leaves at most so much of the residual.
constexpr double kFalls = 0.9;
constexpr int kHalvings = 3;
/// [1] of V: beyond, the iteration has diverged, and would overflow.
constexpr double kDiverged = 0x1p100;
/// A proximal point is found if its equations hold to so much of the last residual, within so many steps.
constexpr double kProximal = 0.01;
constexpr int kProximalSteps = 6;

ContactEquation equationOf(const Contact& contact, const ContactNewton::Options& options) {
  return {.rho = options.rho * contact.mass, .epsilon = options.epsilon};
}

}  // namespace

double ContactNewton::residual(const CoupledContacts& contacts, std::span<const Triple> impulses,
                               std::span<double> q) {
  contacts.velocities(impulses, q);
  double worst = 0;
  for (std::size_t c = 0; c < impulses.size(); ++c) {
    const Contact& contact = contacts.contacts()[c];
    const double violation = contact.violation(impulses[c], contacts.relativeVelocity(contact, q));
    if (!(violation <= worst)) {  // no number is worst of all, and stays
      worst = violation;
    }
  }
  return worst;
}

double ContactNewton::begin(const CoupledContacts& contacts, std::span<const Triple> impulses,
                            std::span<double> q) {
  const std::size_t count = impulses.size();
  impulses_.assign(impulses.begin(), impulses.end());
  admissible_.resize(count);
  u_.resize(count);
  answers_.resize(count);
  q_.resize(q.size());
  dq_.resize(q.size());
  factorisations_ = 0;
  return residual(contacts, impulses, q);
}

/// Moves impulses_ by one full step. Returns false if that leads nowhere.
bool ContactNewton::step(CoupledContacts& contacts, const Options& options, std::span<const Triple> centres,
                         bool sticking) {
  contacts.velocities(impulses_, q_);
  contacts.relativeVelocities(q_, u_);
  for (std::size_t c = 0; c < impulses_.size(); ++c) {
    const Contact& contact = contacts.contacts()[c];
    const ContactEquation equation = equationOf(contact, options);
    answers_[c] = sticking ? stickingAnswer(contact, equation, centres[c], u_[c])
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
  return largest <= kDiverged * contacts.scale();
}

/// Residual of impulses_ brought into their cones.
double ContactNewton::admit(const CoupledContacts& contacts) {
  for (std::size_t c = 0; c < impulses_.size(); ++c) {
    admissible_[c] = contacts.contacts()[c].admissible(impulses_[c]);
  }
  return residual(contacts, admissible_, q_);
}

void ContactNewton::keep(std::span<Triple> impulses, std::span<double> q) const {
  std::copy(admissible_.begin(), admissible_.end(), impulses.begin());
  std::copy(q_.begin(), q_.end(), q.begin());
}

double ContactNewton::improve(CoupledContacts& contacts, std::span<Triple> impulses, std::span<double> q,
                              const Options& options, bool sticking) {
  double best = begin(contacts, impulses, q);
  int stalled = 0;
  while (factorisations_ < options.steps && best > options.enough && stalled < kPatience) {
    if (!step(contacts, options, impulses_, sticking && factorisations_ == 0)) {
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

/// Shortens the step from `from` to impulses_ until the residual falls; leaves the result in admissible_.
/// Returns the fraction taken, 0 if none.
double ContactNewton::fractionThatFalls(const CoupledContacts& contacts, std::span<const Triple> from,
                                        double best) {
  double fraction = 1;
  for (int halvings = 0; halvings <= kHalvings; ++halvings, fraction /= 2) {
    for (std::size_t c = 0; c < from.size(); ++c) {
      Triple between = impulses_[c];
      for (std::size_t k = 0; k < between.size(); ++k) {
        between[k] = from[c][k] + fraction * (between[k] - from[c][k]);
      }
      admissible_[c] = contacts.contacts()[c].admissible(between);
    }
    if (residual(contacts, admissible_, q_) < kFalls * best) {
      return fraction;
    }
  }
  return 0;
}

double ContactNewton::descend(CoupledContacts& contacts, std::span<Triple> impulses, std::span<double> q,
                              Options options) {
  double best = begin(contacts, impulses, q);
  while (factorisations_ < options.steps && best > options.enough && options.epsilon < kMostEpsilon) {
    std::copy(impulses.begin(), impulses.end(), impulses_.begin());
    if (!step(contacts, options, impulses_, false)) {
      break;
    }
    const double fraction = fractionThatFalls(contacts, impulses, best);
    if (fraction > 0) {
      keep(impulses, q);
      best = residual(contacts, impulses, q);
    }
    options.epsilon *= fraction == 1 ? 0.25 : fraction > 0 ? 1 : 64;
  }
  return best;
}

/// From centres_. `error` [m/s]: how well the equations have to hold.
bool ContactNewton::solveProximal(CoupledContacts& contacts, const Options& options, double error,
                                  int& steps) {
  std::copy(centres_.begin(), centres_.end(), impulses_.begin());
  for (steps = 1; steps <= kProximalSteps && factorisations_ < options.steps; ++steps) {
    if (!step(contacts, options, centres_, false)) {
      return false;
    }
    contacts.velocities(impulses_, q_);
    double worst = 0;
    for (std::size_t c = 0; c < impulses_.size(); ++c) {
      const Contact& contact = contacts.contacts()[c];
      const Triple u = contacts.relativeVelocity(contact, q_);
      const double of = equationError(contact, equationOf(contact, options), impulses_[c], centres_[c], u);
      if (!(of <= worst)) {
        worst = of;
      }
    }
    if (worst <= error) {
      return true;
    }
    if (!(worst <= kDiverged * contacts.scale())) {
      return false;
    }
  }
  return false;
}

double ContactNewton::approach(CoupledContacts& contacts, std::span<Triple> impulses, std::span<double> q,
                               Options options) {
  double best = begin(contacts, impulses, q);
  centres_.assign(impulses.begin(), impulses.end());
  double now = best;
  while (factorisations_ < options.steps && best > options.enough && options.epsilon < kMostEpsilon) {
    int steps = 0;
    if (!solveProximal(contacts, options, std::max(kProximal * now, options.enough), steps)) {
      options.epsilon *= 4;
      continue;
    }
    std::copy(impulses_.begin(), impulses_.end(), centres_.begin());
    now = admit(contacts);
    if (now < best) {
      best = now;
      keep(impulses, q);
    }
    options.epsilon = std::max(kLeastEpsilon, options.epsilon / (steps <= 2               ? 8
                                                                 : steps < kProximalSteps ? 2
                                                                                          : 1));
  }
  return best;
}

}  // namespace careen
