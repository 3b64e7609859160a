// Forces on the members of a crowd other than those of contact: gravity, springs, drag.
#include <algorithm>
#include <cmath>

#include "physics/pile/crowd.h"

namespace careen {
namespace {

constexpr double kMostOfSpring = 0x1p-3;  // [rad] phase of the stiffest spring per step
constexpr int kLoadPasses = 3;

}  // namespace

// [s] Springs are integrated with few iterations: stable, and accurate to about the tolerance, for a small
// phase.
void Crowd::limitBySprings(std::size_t listed) {
  for (const Spring& spring : world_.springs) {
    double mobility = 0;  // [1/kg]
    bool attached = false;
    for (const SpringEnd* end : {&spring.from, &spring.to}) {
      if (end->body) {
        const Body& body = world_.bodies[at(*end->body)];
        mobility +=
            body.mass.inverseMass + body.mass.inverseInertiaBody.maxCoeff() * end->point.squaredNorm();
        attached = attached || at(*end->body) == listed;
      }
    }
    if (attached && mobility > 0) {
      const double stiff = std::sqrt(spring.stiffness * mobility) + spring.damping * mobility;
      springLimit_ = stiff > 0 ? std::min(springLimit_, kMostOfSpring / stiff) : springLimit_;
    }
  }
}

// Forces of springs and drag, in the middle of the step, found by iteration (implicit midpoint rule): springs
// don't swing higher and higher.
void Crowd::findLoads() {
  if (worldStates_.empty()) {
    return;
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!bodies_[i].absent) {
      worldStates_[listed_[i]] = stateOf(bodies_[i]);
    }
  }
  computeLoads(world_, worldStates_, loads_);
  for (int pass = 0; pass < kLoadPasses; ++pass) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (!bodies_[i].still()) {
        PileBody halfway = bodies_[i];
        const double ahead = 0.5 * h_;
        halfway.velocity += halfway.behind * accelerationBefore(i) + ahead * acceleration(i);
        halfway.angularMomentum += halfway.behind * torqueBefore(i) + ahead * torque(i);
        halfway.position += ahead * halfway.velocity;
        turnFree(halfway, ahead);
        worldStates_[listed_[i]] = stateOf(halfway);
      }
    }
    computeLoads(world_, worldStates_, loads_);
  }
}

// [m/s²] Without contacts.
Vec3 Crowd::acceleration(std::size_t place) const {
  return loads_.empty() ? world_.gravity : Vec3(bodies_[place].inverseMass * loads_[listed_[place]].force);
}

Vec3 Crowd::accelerationBefore(std::size_t place) const {
  return loadsBefore_.empty() ? world_.gravity
                              : Vec3(bodies_[place].inverseMass * loadsBefore_[listed_[place]].force);
}

// [N m] Likewise.
Vec3 Crowd::torque(std::size_t place) const {
  return loads_.empty() ? Vec3(Vec3::Zero()) : loads_[listed_[place]].torque;
}

Vec3 Crowd::torqueBefore(std::size_t place) const {
  return loadsBefore_.empty() ? Vec3(Vec3::Zero()) : loadsBefore_[listed_[place]].torque;
}

}  // namespace careen
