#include "physics/exact/doubt.h"

#include <algorithm>

namespace careen {

void Doubt::goOn(const Instant& time) {
  place = at(time);
  since = time;
}

void Doubt::atLeast(double length) { place = std::max(place, length); }

void touch(std::span<DoubtfulBody> bodies, const ImpactContact& contact, const ImpactShare& share) {
  DoubtfulBody& a = bodies[static_cast<std::size_t>(contact.a)];
  DoubtfulBody& b = bodies[static_cast<std::size_t>(contact.b)];
  const auto note = [&](DoubtfulBody& one, const DoubtfulBody& other) {
    one.change += (share.impulse + share.tangential) * one.body->mass.inverseMass;
    if (other.doubt != nullptr) {
      one.worst.place = std::max(one.worst.place, other.doubt->place);
      one.worst.speed = std::max(one.worst.speed, other.doubt->speed);
    }
  };
  note(a, b);
  note(b, a);
}

void doubtMore(std::span<DoubtfulBody> bodies) {
  for (DoubtfulBody& each : bodies) {
    if (each.doubt == nullptr) {
      continue;
    }
    Doubt& doubt = *each.doubt;
    const double place = std::max(doubt.place, each.worst.place);
    const double parting = each.change * place / radiusOf(*each.body);
    doubt.speed = std::min(each.speed, std::max(doubt.speed, each.worst.speed) + parting);
  }
}

}  // namespace careen
