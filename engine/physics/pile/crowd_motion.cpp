#include "physics/pile/crowd_motion.h"

#include <atomic>

namespace careen {
namespace {

// By the torque that acts in the middle.
void turnUnderLoad(const CrowdMembers& members, const CrowdLoads& loads, PileBody& body, std::size_t place) {
  if (!loads.any()) {
    turnFree(body, members.h);
    return;
  }
  turnFree(body, 0.5 * members.h);
  body.angularMomentum += body.behind * loads.torqueBefore(place) + members.h * loads.torque(place);
  turnFree(body, 0.5 * members.h);
}

void moveBody(CrowdMembers& members, const CrowdLoads& loads, const CrowdImpulses& impulses, std::size_t i) {
  PileBody& body = members[i];
  CrowdMembers::Way& way = members.ways[i];
  const int index = static_cast<int>(i);
  const PileSolver& solver = impulses.solver();
  const double h = members.h;
  way.shifted = impulses.shiftOf(index);
  way.moved = false;
  if (body.isDriven()) {
    body.path += body.ahead;
    body.turned += body.turning;
    putDriven(body, members.time + h);
  }
  if (body.still()) {
    return;
  }
  way = {.position = body.position,
         .attitude = body.attitude,
         .velocity = body.velocity + body.behind * loads.accelerationBefore(i),
         .omega = body.omega,
         .angularMomentum = body.angularMomentum,
         .kinetic = impulses.kineticBefore(i),
         .shifted = way.shifted,
         .pushed = solver.pushed(index),
         .moved = true};
  if (loads.any()) {
    const Vec3 turned = body.behind * loads.torqueBefore(i);
    way.omega += spinBy(body, turned);
    way.angularMomentum += turned;
  }
  body.path += body.ahead;
  body.turned += body.turning;
  body.position += h * solver.velocity(index);
  if (way.pushed) {
    const double turning = body.radius * (solver.omega(index) - body.omega).norm();
    way.unrest = (solver.velocity(index) - body.velocity).norm() + turning;
    body.path += h * way.unrest;
    body.turned += h * turning;
  }
  const bool shifted = impulses.isShifted(index);
  if (shifted) {
    way.pushed = true;
    body.position += solver.displacement(index);
    body.path += way.shifted;
    body.turned += body.radius * solver.turn(index).norm();
  }
  if (solver.pushed(index)) {
    takeVelocity(body, solver.velocity(index), solver.omega(index));
    way.kinetic = impulses.kineticEnergy(i);
    body.behind = 0.5 * h;
    turnFree(body, h);
  } else {
    body.velocity = solver.velocity(index) + 0.5 * h * loads.acceleration(i);
    turnUnderLoad(members, loads, body, i);
    body.behind = 0;
  }
  if (shifted) {
    turnBy(body, solver.turn(index));
  }
  way.endVelocity = body.velocity;
  way.endOmega = body.omega;
}

}  // namespace

void moveMembers(CrowdMembers& members, const CrowdLoads& loads, const CrowdImpulses& impulses) {
  members.forEach([&](std::size_t i) { moveBody(members, loads, impulses, i); });
}

Vec3 spinBy(const PileBody& body, const Vec3& angularImpulse) {
  const Mat3 axes = body.principalAxes();
  return axes * body.inverseInertiaBody.cwiseProduct(axes.transpose() * angularImpulse);
}

void takeVelocity(PileBody& body, const Vec3& velocity, const Vec3& omega) {
  const Mat3 axes = body.principalAxes();
  const Vec3 change = axes.transpose() * (omega - body.omega);
  body.angularMomentum += axes * body.inertiaBody.cwiseProduct(change);
  body.velocity = velocity;
}

void countUntouched(const CrowdMembers& members, CrowdContacts& contacts, CrowdMemory& memory) {
  members.forEach([&](std::size_t i) {
    int& steps = memory.places[i].untouchedSteps;
    steps = members[i].still() ? 0 : steps + 1;
  });
  contacts.forNear([&](const PileManifold& manifold, std::size_t) {
    for (const int body : {manifold.a, manifold.b}) {
      if (!members[body].still()) {
        std::atomic_ref(memory.places[at(body)].untouchedSteps).store(0, std::memory_order_relaxed);
      }
    }
  });
}

}  // namespace careen
