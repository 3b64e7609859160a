#include "physics/solver/contact_sweeps.h"

#include <algorithm>
#include <cstddef>

namespace careen {
namespace {

constexpr double kDiverged = 0x1p40;  // [1] of V

}  // namespace

void ContactSweeps::start(const CoupledContacts& contacts, std::span<const Triple> impulses) {
  impulses_.assign(impulses.begin(), impulses.end());
  q_.resize(contacts.bodies() * CoupledContacts::kAxes);
  contacts.velocities(impulses_, q_);
}

bool ContactSweeps::sweep(const CoupledContacts& contacts, int times) {
  for (int k = 0; k < times; ++k) {
    double largest = 0;
    for (std::size_t c = 0; c < impulses_.size(); ++c) {
      const CoupledContacts::Contact& contact = contacts.contacts()[c];
      const Triple before = impulses_[c];
      const Triple u = contacts.relativeVelocity(contact, q_);
      const Triple now =
          contact.admissible({before[0] - contact.mass * u[0], before[1] - contact.tangentialMass * u[1],
                              before[2] - contact.tangentialMass * u[2]});
      contacts.apply(contact, {now[0] - before[0], now[1] - before[1], now[2] - before[2]}, q_);
      impulses_[c] = now;
      largest = std::max(largest, now[0] / contact.mass);
    }
    if (!(largest <= kDiverged * contacts.scale())) {
      return false;
    }
  }
  return true;
}

}  // namespace careen
