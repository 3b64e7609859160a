#include "physics/pile/crowd_loads.h"

#include <algorithm>
#include <cmath>

namespace careen {
namespace {

constexpr double kMostOfSpring = 0x1p-3;  // [rad] phase of the stiffest spring per step
constexpr int kLoadPasses = 3;
constexpr double kMostDriven = 2;  // [1] of the tolerance: way that a motor adds in a step

}  // namespace

CrowdLoads::CrowdLoads(const CrowdMembers& members, const CrowdMemory& memory)
    : members_(members), memory_(memory), gravity_(members.world.gravity) {
  if (hasVaryingLoads(members.world) || members.world.control) {
    for (const Body& body : members.world.bodies) {
      states_.push_back(body.initial);
    }
  }
}

// [s] Springs are integrated with few iterations: stable, and accurate to about the tolerance, for a small
// phase.
void CrowdLoads::limitBySprings(std::size_t listed) {
  for (const Spring& spring : members_.world.springs) {
    double mobility = 0;  // [1/kg]
    bool attached = false;
    for (const SpringEnd* end : {&spring.from, &spring.to}) {
      if (end->body) {
        const Body& body = members_.world.bodies[at(*end->body)];
        mobility +=
            body.mass.inverseMass + body.mass.inverseInertiaBody.maxCoeff() * end->point.squaredNorm();
        attached = attached || at(*end->body) == listed;
      }
    }
    if (attached) {
      limit(spring.stiffness, spring.damping, mobility);
    }
  }
  for (const Joint& joint : members_.world.joints) {
    const bool attached =
        joint.from.body == static_cast<int>(listed) || joint.to.body == static_cast<int>(listed);
    if (attached && joint.hasCoordinate()) {
      limit(joint.stiffness, joint.damping, mobilityOf(joint));
    }
  }
}

// [1/kg] or [1/(kg m²)] Of its coordinate, at the most.
double CrowdLoads::mobilityOf(const Joint& joint) const {
  double mobility = 0;
  for (const JointEnd* end : {&joint.from, &joint.to}) {
    if (end->body) {
      const MassProperties& mass = members_.world.bodies[at(*end->body)].mass;
      mobility += joint.kind == Joint::Kind::kSlider ? mass.inverseMass : mass.inverseInertiaBody.maxCoeff();
    }
  }
  return mobility;
}

// [s] What a motor gives in a step moves no point further than a few tolerances.
double CrowdLoads::longestStep() const {
  double strongest = 0;  // [m/s²]
  for (const Joint& joint : members_.world.joints) {
    if (joint.effort != 0) {
      const double reach =
          joint.kind == Joint::Kind::kSlider ? 1 : radiusOf(members_.world.bodies[at(*joint.from.body)]);
      strongest = std::max(strongest, reach * std::abs(joint.effort) * mobilityOf(joint));
    }
  }
  return strongest > 0 ? std::min(longestStep_, std::sqrt(2 * kMostDriven * members_.tolerance / strongest))
                       : longestStep_;
}

void CrowdLoads::limit(double stiffness, double damping, double mobility) {
  const double stiff = std::sqrt(stiffness * mobility) + damping * mobility;  // [1/s]
  longestStep_ = stiff > 0 ? std::min(longestStep_, kMostOfSpring / stiff) : longestStep_;
}

// Forces of springs and drag, in the middle of the step, found by iteration (implicit midpoint rule): springs
// don't swing higher and higher.
void CrowdLoads::find() {
  gravity_ = gravityNow(members_.world, members_.time + 0.5 * members_.h);
  if (states_.empty()) {
    return;
  }
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (!members_[i].absent && members_[i].isBox()) {
      states_[members_.listed[i]] = stateOf(members_[i]);
    }
  }
  computeLoads(members_.world, gravity_, states_, loads_);
  for (int pass = 0; pass < kLoadPasses; ++pass) {
    for (std::size_t i = 0; i < members_.size(); ++i) {
      if (!members_[i].still()) {
        PileBody halfway = members_[i];
        const double ahead = 0.5 * members_.h;
        halfway.velocity += halfway.behind * accelerationBefore(i) + ahead * acceleration(i);
        halfway.angularMomentum += halfway.behind * torqueBefore(i) + ahead * torque(i);
        halfway.position += ahead * halfway.velocity;
        turnFree(halfway, ahead);
        states_[members_.listed[i]] = stateOf(halfway);
      }
    }
    computeLoads(members_.world, gravity_, states_, loads_);
  }
}

Vec3 CrowdLoads::acceleration(std::size_t place) const {
  return loads_.empty()           ? gravity_
         : members_[place].held() ? Vec3(Vec3::Zero())
                                  : Vec3(members_[place].inverseMass * loads_[members_.listed[place]].force);
}

Vec3 CrowdLoads::accelerationBefore(std::size_t place) const {
  return memory_.loads.empty()
             ? gravityNow(members_.world, members_.time - 0.5 * memory_.length)
             : Vec3(members_[place].inverseMass * memory_.loads[members_.listed[place]].force);
}

Vec3 CrowdLoads::torque(std::size_t place) const {
  return loads_.empty() ? Vec3(Vec3::Zero()) : loads_[members_.listed[place]].torque;
}

Vec3 CrowdLoads::torqueBefore(std::size_t place) const {
  return memory_.loads.empty() ? Vec3(Vec3::Zero()) : memory_.loads[members_.listed[place]].torque;
}

}  // namespace careen
