#include "physics/solver/contact_newton.h"

#include <algorithm>
#include <cmath>

namespace careen {

double ContactNewton::residual(const CoupledContacts& contacts, std::span<const Triple> impulses,
                               std::span<double> q) {
  contacts.velocities(impulses, q);
  double worst = 0;
  for (std::size_t c = 0; c < impulses.size(); ++c) {
    const CoupledContacts::Contact& contact = contacts.contacts()[c];
    const double violation = contact.violation(impulses[c], contacts.relativeVelocity(contact, q));
    if (!(violation <= worst)) {  // no number is worst of all
      worst = violation;
    }
  }
  return worst;
}

bool ContactNewton::step(CoupledContacts& contacts, const Options& options, bool sticking) {
  contacts.velocities(impulses_, q_);
  contacts.relativeVelocities(q_, u_);
  for (std::size_t c = 0; c < impulses_.size(); ++c) {
    const CoupledContacts::Contact& contact = contacts.contacts()[c];
    const double rho = options.rho * contact.mass;
    if (sticking) {
      answerSticking(contact, impulses_[c], u_[c], rho, options.epsilon, answers_[c]);
    } else {
      answerByNewton(contact, impulses_[c], u_[c], rho, options.epsilon, answers_[c]);
    }
  }
  ++factorisations_;
  if (!contacts.factorise(answers_)) {
    return false;
  }
  contacts.step(answers_, q_, dq_);
  for (std::size_t c = 0; c < impulses_.size(); ++c) {
    const ContactAnswer& answer = answers_[c];
    if (answer.stiffness[0] == 0) {
      impulses_[c] = {};
      continue;
    }
    const Triple du = contacts.change(contacts.contacts()[c], dq_);
    for (std::size_t k = 0; k < 3; ++k) {
      const double* row = &answer.stiffness[3 * k];
      impulses_[c][k] = answer.given[k] - (row[0] * du[0] + (row[1] * du[1] + row[2] * du[2]));
    }
  }
  return true;
}

double ContactNewton::improve(CoupledContacts& contacts, std::span<Triple> impulses, std::span<double> q,
                              const Options& options, double enough) {
  const std::size_t count = impulses.size();
  impulses_.assign(impulses.begin(), impulses.end());
  admissible_.resize(count);
  u_.resize(count);
  answers_.resize(count);
  q_.resize(q.size());
  dq_.resize(q.size());
  factorisations_ = 0;
  double best = residual(contacts, impulses, q);
  int stalled = 0;
  for (int k = 0; k < options.steps && best > enough && stalled < 4; ++k) {
    if (!step(contacts, options, options.stickFirst && k == 0)) {
      break;
    }
    for (std::size_t c = 0; c < count; ++c) {
      admissible_[c] = contacts.contacts()[c].admissible(impulses_[c]);
    }
    const double now = residual(contacts, admissible_, q_);
    if (!std::isfinite(now)) {
      break;
    }
    stalled = now < best / 2 ? 0 : stalled + 1;
    if (now < best) {
      best = now;
      std::copy(admissible_.begin(), admissible_.end(), impulses.begin());
      std::copy(q_.begin(), q_.end(), q.begin());
    }
  }
  return best;
}

}  // namespace careen
