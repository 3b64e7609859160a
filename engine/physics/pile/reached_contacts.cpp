#include "physics/pile/reached_contacts.h"

#include <algorithm>
#include <utility>

#include "physics/pile/belts.h"
#include "physics/pile/index.h"

namespace careen {

void ReachedContacts::begin() {
  fastest_ = 0;
  points_.clear();
  bodies_.clear();
  changed_.clear();
  reachedAt_.assign(members_.size(), kNobody);
  firstPoint_.assign(contacts_.manifoldCount(), kNobody);
  firstSlot_.assign(members_.size() + 1, 0);
  const auto forSides = [&](const auto& use) {
    for (const int slot : contacts_.near()) {
      const PileManifold& manifold = contacts_[slot];
      use(manifold.a, slot);
      use(manifold.b, slot);
    }
  };
  forSides([&](int place, int) { ++firstSlot_[at(place) + 1]; });
  for (std::size_t i = 0; i < members_.size(); ++i) {
    firstSlot_[i + 1] += firstSlot_[i];
  }
  slots_.resize(at(firstSlot_.back()));
  std::vector<int> next(firstSlot_.begin(), firstSlot_.end() - 1);
  forSides([&](int place, int slot) { slots_[at(next[at(place)]++)] = slot; });
}

void ReachedContacts::strike(int slot, int index, double approach) {
  const int first = listManifold(slot);
  for (std::size_t p = at(first); p < points_.size() && points_[p].slot == slot; ++p) {
    if (points_[p].index == index) {
      points_[p].before = -approach;
      points_[p].strikes = true;
      fastest_ = std::max(fastest_, approach);
    }
  }
}

int ReachedContacts::reach(int place) {
  if (members_[place].still()) {
    return kNobody;
  }
  if (reachedAt_[at(place)] == kNobody) {
    reachedAt_[at(place)] = static_cast<int>(bodies_.size());
    bodies_.push_back({.place = place, .mass = solverBody(members_[place], 0)});
  }
  return reachedAt_[at(place)];
}

int ReachedContacts::listManifold(int slot) {
  if (firstPoint_[at(slot)] != kNobody) {
    return firstPoint_[at(slot)];
  }
  const PileManifold& manifold = contacts_[slot];
  firstPoint_[at(slot)] = static_cast<int>(points_.size());
  const std::array<int, 2> bodies{reach(manifold.a), reach(manifold.b)};
  const Vec3 apart = members_.apart(manifold.a, manifold.b);
  for (int k = 0; k < manifold.count; ++k) {
    const PilePoint& from = manifold.points[at(k)];
    if (from.row < 0) {
      continue;
    }
    ReachedPoint point{.slot = slot,
                       .index = k,
                       .bodies = bodies,
                       .arms = {from.world, from.world + apart},
                       .normal = manifold.frameOf(k).normal,
                       .restitution = manifold.material.restitution,
                       .friction = manifold.material.friction,
                       .before = std::max(0.0, from.speed)};
    for (std::size_t side = 0; side < 2; ++side) {
      if (bodies[side] != kNobody) {
        const CrowdMembers::Way& way = members_.ways[at(bodies_[at(bodies[side])].place)];
        const Vec3 velocity = way.velocity + way.omega.cross(point.arms[side]);
        point.slip += side == 0 ? velocity : Vec3(-velocity);
        bodies_[at(bodies[side])].points.push_back(static_cast<int>(points_.size()));
      }
    }
    if (isOnBelt(members_, manifold)) {
      point.slip -= velocityOfBelt(members_, manifold, manifold.frameOf(k), from);
    }
    point.mass = massAlong(point, point.normal, 1);
    point.slip -= dot(point.normal, point.slip) * point.normal;
    points_.push_back(point);
  }
  return firstPoint_[at(slot)];
}

// bodies_ may grow in it.
void ReachedContacts::listPoints(int body) {
  if (bodies_[at(body)].isListed) {
    return;
  }
  bodies_[at(body)].isListed = true;
  const int place = bodies_[at(body)].place;
  for (int n = firstSlot_[at(place)]; n < firstSlot_[at(place) + 1]; ++n) {
    listManifold(slots_[at(n)]);
  }
}

Vec3 ReachedContacts::change(const ReachedPoint& point) const {
  Vec3 change = Vec3::Zero();
  for (std::size_t side = 0; side < 2; ++side) {
    if (point.bodies[side] != kNobody) {
      const ReachedBody& body = bodies_[at(point.bodies[side])];
      const Vec3 ofPoint = body.velocity + body.omega.cross(point.arms[side]);
      change += side == 0 ? ofPoint : Vec3(-ofPoint);
    }
  }
  return change;
}

Vec3 ReachedContacts::sliding(const ReachedPoint& point) const {
  const Vec3 change = this->change(point);
  return point.slip + change - dot(point.normal, change) * point.normal;
}

double ReachedContacts::massAlong(const ReachedPoint& point, const Vec3& vector, double length) const {
  double inverse = 0;
  for (std::size_t side = 0; side < 2; ++side) {
    if (point.bodies[side] != kNobody) {
      const SolverBody& mass = bodies_[at(point.bodies[side])].mass;
      const Vec3 turn = point.arms[side].cross(vector) / length;
      inverse += mass.inverseMass + dot(turn, mass.turned(turn));
    }
  }
  return inverse > 0 ? 1 / inverse : 0;
}

void ReachedContacts::push(const ReachedPoint& point, const Vec3& impulse) {
  for (std::size_t side = 0; side < 2; ++side) {
    if (point.bodies[side] != kNobody) {
      ReachedBody& body = bodies_[at(point.bodies[side])];
      const Vec3 pushed = side == 0 ? impulse : Vec3(-impulse);
      body.velocity += body.mass.inverseMass * pushed;
      body.omega += body.mass.turned(point.arms[side].cross(pushed));
    }
  }
  note(point);
}

void ReachedContacts::note(const ReachedPoint& point) {
  for (const int body : point.bodies) {
    if (body != kNobody && !bodies_[at(body)].changed) {
      bodies_[at(body)].changed = true;
      changed_.push_back(body);
    }
  }
}

void ReachedContacts::setVelocities(double (*impulseOf)(const ReachedPoint&)) {
  for (ReachedBody& body : bodies_) {
    body.velocity = body.omega = Vec3::Zero();
    body.changed = false;
    body.stirred = 0;
  }
  changed_.clear();
  for (const ReachedPoint& point : points_) {
    if (const double impulse = impulseOf(point); impulse != 0) {
      push(point, impulse);
    }
  }
}

void ReachedContacts::swap(const ReachedPoint& point, Velocities& velocities) {
  for (std::size_t side = 0; side < 2; ++side) {
    if (point.bodies[side] != kNobody) {
      std::swap(velocities.velocity[side], bodies_[at(point.bodies[side])].velocity);
      std::swap(velocities.omega[side], bodies_[at(point.bodies[side])].omega);
    }
  }
}

void ReachedContacts::findFront(std::span<const int> more, std::vector<int>& front) {
  front.assign(more.begin(), more.end());
  forPushed([&](std::span<const int> points) { front.insert(front.end(), points.begin(), points.end()); });
  std::sort(front.begin(), front.end());
  front.erase(std::unique(front.begin(), front.end()), front.end());
}

// Whether one of its bodies was pushed since the last sweep; in the first one all are.
bool ReachedContacts::isDue(const ReachedPoint& point, int sweep) const {
  return std::any_of(point.bodies.begin(), point.bodies.end(),
                     [&](int body) { return body != kNobody && bodies_[at(body)].stirred >= sweep - 1; });
}

void ReachedContacts::stir(const ReachedPoint& point, int sweep) {
  for (const int body : point.bodies) {
    if (body != kNobody) {
      bodies_[at(body)].stirred = sweep;
    }
  }
}

}  // namespace careen
