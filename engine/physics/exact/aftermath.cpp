#include "physics/exact/aftermath.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "physics/contact/island.h"
#include "physics/exact/encounter_contacts.h"
#include "physics/exact/island_forming.h"
#include "physics/geometry/separation.h"
#include "physics/impact/settling.h"
#include "physics/world/forces.h"

namespace careen {
namespace {

/// [1] Separation speeds, and accelerations, this small relative to those of the bodies count as zero.
constexpr double kParting = 0x1p-40;
/// [1] of timeScaleOf: changes of contact within it are counted together.
constexpr double kChatterWindow = 8;

// Bodies whose contacts change too often to follow each change go on by time steps: first a few, then twice
// as many each time that was not enough. Those that meet without an impact pass each other.
void findChattering(const Bodies& bodies, Encounter& encounter) {
  constexpr int kMostInWindow = 12;
  constexpr int kMostPassing = 256;
  constexpr int kMostAlone = 64;  // 2e-9 m high at a tolerance of 1e-6 m
  constexpr double kEndless = 1 - 0x1p-12;
  constexpr int kFirstTimeSteps = 16;
  constexpr int kMostTimeSteps = 4096;
  constexpr double kAgain = 256;  // windows
  // Infinite if nothing moves at the start and there is no gravity.
  const double window = std::isfinite(bodies.timeScale()) ? kChatterWindow * bodies.timeScale() : 0;
  int most = 0;
  int before = 0;
  int movable = 0;
  bool touching = false;
  for (const EncounterBody& each : encounter.bodies) {
    Mover& body = *each.mover;
    if (body.isHeld()) {
      continue;
    }
    if (secondsBetween(body.windowStart, encounter.time) > window) {
      body.windowStart = encounter.time;
      body.changesInWindow = 0;
    }
    ++body.changesInWindow;
    ++movable;
    touching = touching || body.steps();
    most = std::max(most, body.changesInWindow);
    if (body.timeSteps > 0 && secondsBetween(body.chatteredFrom, encounter.time) < kAgain * window) {
      before = std::max(before, body.timeSteps);
    }
  }
  // A single bouncing body is followed to the end: the time at which it comes to rest is exact. If it loses
  // nothing, there is none, and hops so low that they do not show would go on for ever. Bodies that only fly
  // and strike without gravity are followed too: their impacts are finite in number.
  const bool falls = encounter.pull > 0;
  const bool endless =
      std::any_of(encounter.contacts.begin(), encounter.contacts.end(),
                  [](const ImpactContact& contact) { return contact.material.restitution > kEndless; });
  const bool returns = falls && (movable > 1 || (endless && most > kMostAlone));
  if (most > kMostInWindow && encounter.timeSteps == 0 && (touching || returns)) {
    encounter.timeSteps = std::clamp(2 * before, kFirstTimeSteps, kMostTimeSteps);
    for (const EncounterBody& each : encounter.bodies) {
      each.mover->timeSteps = encounter.timeSteps;
      each.mover->chatteredFrom = encounter.time;
    }
  } else if (most > kMostInWindow && encounter.cause != EventKind::kStep &&
             std::none_of(encounter.shares.begin(), encounter.shares.end(),
                          [](const ImpactShare& share) { return share.impulse > 0; })) {
    encounter.passing = kHardlyParts;
    encounter.timeSteps = std::max(encounter.timeSteps, most > kMostPassing ? kFirstTimeSteps : 0);
    encounter.cause = EventKind::kTouching;
  }
}

// [m] See settles(). An island's hop may end as deep as Island ignores.
double hopRounding(const Encounter& encounter, const EncounterBody& body, std::size_t k) {
  const double lengths = encounter.lengthsAt(k);
  return body.mover->steps()
             ? Island::kTouching / kRoundingsOfAHop * touchingWithin(radiusOf(body.body()), lengths)
             : kGapRounding * lengths;
}

// Contacts whose next hop is too short to follow persist; `load`: by springs and drag too, if they act. If
// the body thereby comes to rest on immovable things, its Rest begins when all its hops would have ended.
void settleBody(const Bodies& bodies, Encounter& encounter, std::size_t index, const Load& load) {
  EncounterBody& each = encounter.bodies[index];
  const Body& body = each.body();
  BodyState& state = each.after;
  const Vec3 omega = angularVelocity(body.mass, state);
  const Vec3 omegaRate = inverseInertiaWorld(body.mass, state.pose.worldFromBody) *
                         (load.torque + state.angularMomentum.cross(omega));
  const bool isPulled = bodies.isForced(each.mover->rank);
  const Vec3 gravity = gravityNow(bodies.world(), encounter.time.hi);
  const Vec3 pull = isPulled ? Vec3(body.mass.inverseMass * load.force) : gravity;
  double tail = -1;
  bool alone = !isPulled && !isGravitySloping(bodies.world());
  Settling settling;
  settling.velocity = state.velocity;
  settling.angularVelocity = omega;
  settling.gravity = gravity;
  std::vector<Vec3> arms;
  for (std::size_t k = 0; k < encounter.contacts.size(); ++k) {
    const ImpactContact& contact = encounter.contacts[k];
    const bool isA = contact.a == static_cast<int>(index);
    if ((!isA && contact.b != static_cast<int>(index)) || contact.rows) {
      continue;
    }
    const Mover& other = *(isA ? encounter.b(k) : encounter.a(k)).mover;
    alone = alone && other.isHeld() && !other.isDriven() && !contact.material.surface.moves();
    const Vec3 normal = isA ? contact.normal : Vec3(-contact.normal);
    const Vec3& arm = isA ? contact.armA : contact.armB;
    if (!contact.directions.empty() && !(encounter.shares[k].impulse > 0)) {
      continue;  // it did not have to push
    }
    Vec3 acceleration = pull + omegaRate.cross(arm) + omega.cross(omega.cross(arm));
    if (other.isDriven()) {
      const Kinematics driven = other.drivenBy->at(encounter.time.hi);
      const Vec3& armOf = isA ? contact.armB : contact.armA;
      acceleration -=
          driven.accelerationAt(armOf) + driven.angularVelocity.cross(driven.angularVelocity.cross(armOf));
    }
    const double normalAcceleration = dot(normal, acceleration);
    const bool returns =
        std::fabs(normalAcceleration) > kParting * acceleration.norm();  // along a wall it is rounding
    const Bouncing bouncing{.acceleration = returns ? normalAcceleration : 0,
                            .departure = std::max(0.0, partingAt(encounter, k).speed),
                            .restitution = contact.material.restitution,
                            .gapRounding = hopRounding(encounter, each, k)};
    if (!settles(bouncing, body.thinnest())) {
      continue;
    }
    encounter.persists[k] = 1;
    tail = std::max(tail, settlingTail(bouncing));
    arms.push_back(arm);
    settling.normal = normal;
    settling.friction = contact.material.friction;
    settling.speed = std::max(settling.speed, encounter.shares[k].approach);
  }
  if (tail < 0 || !alone) {
    return;
  }
  settling.arms = arms;
  settling.velocity -= dot(settling.normal, settling.velocity) * settling.normal;
  if (afterTail(settling) == Settled::kRests) {
    state = {.pose = state.pose};
    each.next = NextMotion::kRests;
    each.since = instantAfter(encounter.time, tail);
  }
}

// Contacts that neither approach nor separate persist; so do those that close again soon, if bodies chatter
// or the search has found that their gap stays zero.
void findPersisting(const Bodies& bodies, Encounter& encounter) {
  const bool hops = encounter.cause == EventKind::kTouching;
  const double slow = hops ? fallSpeed(bodies, encounter) : 0;
  for (std::size_t k = 0; k < encounter.contacts.size(); ++k) {
    if (encounter.contacts[k].holds) {
      encounter.persists[k] = 1;
      continue;
    }
    const Parting parting = partingAt(encounter, k);
    const bool passes =
        !(encounter.shares[k].impulse > 0) && parting.speed < encounter.passing * parting.rounding;
    if (encounter.timeSteps > 0 || passes || parting.speed <= std::max(slow, parting.rounding)) {
      encounter.persists[k] = 1;
      choose(bodies, encounter, k, parting.velocity);
    }
  }
}

}  // namespace

Parting partingAt(const Encounter& encounter, std::size_t contact) {
  const ImpactContact& at = encounter.contacts[contact];
  Parting parting;
  if (at.rows) {
    const auto addRow = [&](const EncounterBody& body, const RowSide& side) {
      const Vec3 spin = angularVelocity(body.body().mass, body.after);
      parting.speed += dot(side.linear[0], body.after.velocity) + dot(side.turning[0], spin);
      parting.rounding += kParting * (body.after.velocity.norm() + spin.norm() * side.turning[0].norm());
    };
    addRow(encounter.a(contact), at.rows->a);
    addRow(encounter.b(contact), at.rows->b);
    return parting;
  }
  const auto add = [&](const EncounterBody& body, const Vec3& arm, double sign) {
    const Vec3 spin = angularVelocity(body.body().mass, body.after);
    const Vec3 ofPoint = body.after.velocity + spin.cross(arm);
    parting.velocity += sign * ofPoint;
    parting.speed += sign * dot(at.normal, ofPoint);
    parting.rounding += kParting * (body.after.velocity.norm() + spin.norm() * arm.norm() +
                                    kParting * std::sqrt(encounter.pull * radiusOf(body.body())));
  };
  add(encounter.a(contact), at.armA, 1);
  add(encounter.b(contact), at.armB, -1);
  if (!at.directions.empty()) {
    parting.speed = partingSpeed(at.directions, parting.velocity);
  }
  return parting;
}

void settle(Bodies& bodies, Encounter& encounter) {
  findChattering(bodies, encounter);
  std::vector<Load> loads;
  if (isAnyForced(bodies, encounter)) {
    computeLoads(bodies.world(), gravityNow(bodies.world(), encounter.time.hi),
                 statesIn(bodies.world(), encounter, &EncounterBody::after), loads);
  }
  for (std::size_t i = 0; i < encounter.bodies.size(); ++i) {
    EncounterBody& body = encounter.bodies[i];
    body.since = encounter.time;
    if (body.mover->isHeld() || (!body.mover->moves() && movesAlike(body.before, body.after))) {
      continue;
    }
    body.next = NextMotion::kFlies;
    if (encounter.pull > 0 && encounter.timeSteps == 0) {
      settleBody(bodies, encounter, i,
                 bodies.isForced(body.mover->rank) ? loads[static_cast<std::size_t>(body.listed())] : Load{});
    }
  }
  findPersisting(bodies, encounter);
  formIslands(bodies, encounter);
}

}  // namespace careen
