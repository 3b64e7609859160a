#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "core/disjoint_sets.h"
#include "physics/exact/exact_world.h"
#include "physics/geometry/contact_points.h"
#include "physics/geometry/separation.h"
#include "physics/impact/settling.h"
#include "physics/search/first_contact_search.h"

// The next motion of touching bodies: Flight, Contact or Rest.

namespace careen {
namespace {

/// [1] Separation speeds, and accelerations, this small relative to those of the bodies count as zero.
constexpr double kParting = 0x1p-40;
/// [1] of the speed gained by falling through the tolerance: below it chattering has ended.
constexpr double kAllButStill = 0x1p-4;

/// Of more bodies that touch, some contact changes before a smooth step ends: they go on by so many time
/// steps.
constexpr std::size_t kMostSmooth = 6;
constexpr int kTimeStepsOfMany = 64;
/// Of bodies whose hops, too low to follow, cannot be left out.
constexpr int kTimeStepsOfHops = 16;
/// [1] of the speed gained by falling through the tolerance: what leaving them out may take at most. More it
/// takes of bodies that rock together, whose contact hardly opens.
constexpr double kMostTaken = 4;

bool movesAlike(const BodyState& x, const BodyState& y) {
  return x.velocity == y.velocity && x.angularMomentum == y.angularMomentum;
}

// [m/s] Of any body, its corners included.
double fastestChange(const std::vector<TouchingBody>& before, const std::vector<TouchingBody>& after) {
  double fastest = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!before[i].isHeld()) {
      const Vec3 turning = after[i].angularVelocityBody - before[i].angularVelocityBody;
      fastest = std::max(fastest, (after[i].velocity - before[i].velocity).norm() +
                                      turning.norm() * radiusOf(*before[i].body));
    }
  }
  return fastest;
}

}  // namespace

// Bodies whose contacts change too often to follow each change go on by time steps: first a few, then twice
// as many each time that was not enough. Those that meet without an impact pass each other.
void ExactWorld::findChattering(Encounter& encounter) {
  constexpr int kMostInWindow = 12;
  constexpr int kMostPassing = 256;
  constexpr int kMostAlone = 64;  // 2e-9 m high at a tolerance of 1e-6 m
  constexpr double kEndless = 1 - 0x1p-12;
  constexpr int kFirstTimeSteps = 16;
  constexpr int kMostTimeSteps = 4096;
  constexpr double kAgain = 256;  // windows
  // Infinite if nothing moves at the start and there is no gravity.
  const double window = std::isfinite(timeScale_) ? kChatterWindow * timeScale_ : 0;
  int most = 0;
  int before = 0;
  int movable = 0;
  bool touching = false;
  for (const int rank : encounter.ranks) {
    Mover& body = mover(rank);
    if (body.isHeld()) {
      continue;
    }
    if (secondsBetween(body.windowStart, encounter.time) > window) {
      body.windowStart = encounter.time;
      body.changesInWindow = 0;
    }
    ++body.changesInWindow;
    ++movable;
    touching = touching || body.touches();
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
    for (const int rank : encounter.ranks) {
      mover(rank).timeSteps = encounter.timeSteps;
      mover(rank).chatteredFrom = encounter.time;
    }
  } else if (most > kMostInWindow && encounter.cause != EventKind::kStep &&
             std::none_of(encounter.shares.begin(), encounter.shares.end(),
                          [](const ImpactShare& share) { return share.impulse > 0; })) {
    encounter.passing = kHardlyParts;
    encounter.timeSteps = std::max(encounter.timeSteps, most > kMostPassing ? kFirstTimeSteps : 0);
    encounter.cause = EventKind::kTouching;
  }
}

void ExactWorld::settle(Encounter& encounter) {
  findChattering(encounter);
  std::vector<Load> loads;
  if (std::any_of(encounter.ranks.begin(), encounter.ranks.end(), [&](int rank) { return isForced(rank); })) {
    computeLoads(world_, statesIn(encounter, encounter.after), loads);
  }
  for (std::size_t i = 0; i < encounter.ranks.size(); ++i) {
    const Mover& body = mover(encounter.ranks[i]);
    if (body.isHeld() || (!body.moves() && movesAlike(encounter.before[i], encounter.after[i]))) {
      continue;
    }
    encounter.next[i] = Next::kFlies;
    if (encounter.pull > 0 && encounter.timeSteps == 0) {
      settleBody(encounter, i,
                 isForced(encounter.ranks[i]) ? loads[static_cast<std::size_t>(body.listed.value)] : Load{});
    }
  }
  findPersisting(encounter);
  formIslands(encounter);
}

// [m] Scale of the lengths whose difference is the gap at contact k. A wall's offset is no larger than the
// body's part.
double ExactWorld::lengthsAt(const Encounter& encounter, std::size_t k) const {
  const auto of = [&](int index) {
    const auto i = static_cast<std::size_t>(index);
    return encounter.after[i].pose.position.cwiseAbs().sum() + radiusOf(*mover(encounter.ranks[i]).body);
  };
  const ImpactContact& contact = encounter.contacts[k];
  return of(contact.a) + of(contact.b.isWall() ? contact.a : contact.b.body());
}

// [m] See settles(). An island's hop may end as deep as Island ignores.
double ExactWorld::hopRounding(const Encounter& encounter, std::size_t index, std::size_t k) const {
  const double lengths = lengthsAt(encounter, k);
  return mover(encounter.ranks[index]).touches()
             ? Island::kTouching / kRoundingsOfAHop *
                   touchingWithin(radiusOf(*mover(encounter.ranks[index]).body), lengths)
             : kGapRounding * lengths;
}

// Contacts whose next hop is too short to follow persist; `load`: by springs and drag too, if they act. If
// the body thereby comes to rest on immovable things, its Rest begins when all its hops would have ended.
void ExactWorld::settleBody(Encounter& encounter, std::size_t index, const Load& load) const {
  const Body& body = *mover(encounter.ranks[index]).body;
  BodyState& state = encounter.after[index];
  const Vec3 omega = careen::angularVelocity(body.mass, state);
  const Vec3 omegaRate = inverseInertiaWorld(body.mass, state.pose.worldFromBody) *
                         (load.torque + state.angularMomentum.cross(omega));
  const bool isPulled = isForced(encounter.ranks[index]);
  const Vec3 pull = isPulled ? Vec3(body.mass.inverseMass * load.force) : world_.gravity;
  double tail = -1;
  bool alone = !isPulled;
  Settling settling;
  settling.velocity = state.velocity;
  settling.angularVelocity = omega;
  settling.gravity = world_.gravity;
  std::vector<Vec3> arms;
  for (std::size_t k = 0; k < encounter.contacts.size(); ++k) {
    const ImpactContact& contact = encounter.contacts[k];
    const bool isA = contact.a == static_cast<int>(index);
    if (!isA && !contact.b.isBody(static_cast<int>(index))) {
      continue;
    }
    const Partner other = isA ? contact.b : Partner::ofBody(contact.a);
    alone =
        alone && (other.isWall() || mover(encounter.ranks[static_cast<std::size_t>(other.body())]).isHeld());
    const Vec3 normal = isA ? contact.normal : Vec3(-contact.normal);
    const Vec3& arm = isA ? contact.armA : contact.armB;
    if (!contact.directions.empty() && !(encounter.shares[k].impulse > 0)) {
      continue;  // it did not have to push
    }
    const Vec3 acceleration = pull + omegaRate.cross(arm) + omega.cross(omega.cross(arm));
    const double normalAcceleration = dot(normal, acceleration);
    const bool returns =
        std::fabs(normalAcceleration) > kParting * acceleration.norm();  // along a wall it is rounding
    const Bouncing bouncing{.acceleration = returns ? normalAcceleration : 0,
                            .departure = std::max(0.0, partingAt(encounter, k).speed),
                            .restitution = contact.material.restitution,
                            .gapRounding = hopRounding(encounter, index, k)};
    if (!settles(bouncing, body.halfExtents.minCoeff())) {
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
    encounter.next[index] = Next::kRests;
    encounter.since[index] = instantAfter(encounter.time, tail);
  }
}

ExactWorld::Parting ExactWorld::partingAt(const Encounter& encounter, std::size_t contact) const {
  const ImpactContact& at = encounter.contacts[contact];
  Parting parting;
  const auto add = [&](int index, const Vec3& arm, double sign) {
    const auto i = static_cast<std::size_t>(index);
    const Body& body = *mover(encounter.ranks[i]).body;
    const Vec3 spin = careen::angularVelocity(body.mass, encounter.after[i]);
    const Vec3 ofPoint = encounter.after[i].velocity + spin.cross(arm);
    parting.velocity += sign * ofPoint;
    parting.speed += sign * dot(at.normal, ofPoint);
    parting.rounding += kParting * (encounter.after[i].velocity.norm() + spin.norm() * arm.norm() +
                                    kParting * std::sqrt(encounter.pull * radiusOf(body)));
  };
  add(at.a, at.armA, 1);
  if (!at.b.isWall()) {
    add(at.b.body(), at.armB, -1);
  }
  if (!at.directions.empty()) {
    parting.speed = partingSpeed(at.directions, parting.velocity);
  }
  return parting;
}

// Contacts that neither approach nor separate persist; so do those that close again soon, if bodies chatter
// or the search has found that their gap stays zero.
void ExactWorld::findPersisting(Encounter& encounter) const {
  const bool hops = encounter.cause == EventKind::kTouching;
  const double slow = hops ? fallSpeed(encounter) : 0;
  for (std::size_t k = 0; k < encounter.contacts.size(); ++k) {
    const Parting parting = partingAt(encounter, k);
    const bool passes =
        !(encounter.shares[k].impulse > 0) && parting.speed < encounter.passing * parting.rounding;
    if (encounter.timeSteps > 0 || passes || parting.speed <= std::max(slow, parting.rounding)) {
      encounter.persists[k] = 1;
      choose(encounter, k, parting.velocity);
    }
  }
}

void ExactWorld::formIslands(Encounter& encounter) const {
  const std::size_t count = encounter.ranks.size();
  DisjointSets joined(count);
  const auto takesPart = [&](std::size_t i) {
    return !mover(encounter.ranks[i]).isHeld() && encounter.next[i] != Next::kRests;
  };
  for (std::size_t k = 0; k < encounter.contacts.size(); ++k) {
    const ImpactContact& contact = encounter.contacts[k];
    if (encounter.persists[k] != 0 && !contact.b.isWall()) {
      const auto a = static_cast<std::size_t>(contact.a);
      const auto b = static_cast<std::size_t>(contact.b.body());
      if (takesPart(a) && takesPart(b)) {
        joined.join(a, b);
      }
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i + 1; encounter.timeSteps > 0 && j < count; ++j) {
      if (takesPart(i) && takesPart(j) &&
          areTouching(boxOf(encounter, i), boxOf(encounter, j), nearness(encounter))) {
        joined.join(i, j);
      }
    }
    for (const int other : springs_[static_cast<std::size_t>(encounter.ranks[i])]) {
      const auto at = std::find(encounter.ranks.begin(), encounter.ranks.end(), other);
      const auto j = static_cast<std::size_t>(at - encounter.ranks.begin());
      if (takesPart(i) && takesPart(j)) {
        joined.join(i, j);
      }
    }
  }
  for (std::size_t first = 0; first < count; ++first) {
    std::vector<std::size_t> members;
    for (std::size_t i = first; i < count; ++i) {
      if (joined.root(i) == first && takesPart(i)) {
        members.push_back(i);
      }
    }
    if (!members.empty()) {
      formIsland(encounter, members);
    }
  }
}

TouchingBody ExactWorld::touchingBody(const Encounter& encounter, std::size_t index) const {
  const Mover& body = mover(encounter.ranks[index]);
  const BodyState& state = encounter.after[index];
  return {.body = body.body,
          .index = body.listed.value,
          .position = state.pose.position,
          .worldFromBody = encounter.attitudes[index],
          .velocity = state.velocity,
          .angularVelocityBody = body.body->mass.inverseInertiaTimes(state.pose.worldFromBody.transpose() *
                                                                     state.angularMomentum)};
}

ContactFeature ExactWorld::featureOf(const Encounter& encounter, std::size_t k) const {
  const ImpactContact& contact = encounter.contacts[k];
  const auto a = static_cast<std::size_t>(contact.a);
  const Pose& pose = encounter.after[a].pose;
  const Body& body = *mover(encounter.ranks[a]).body;
  ContactFeature feature;
  if (contact.b.isWall()) {
    const Vec3 at = pose.worldFromBody.transpose() * contact.armA - body.boxCenter;
    feature.a = contact.a;
    feature.b = contact.b;
    for (int i = 0; i < 3; ++i) {
      feature.onA[i] = body.boxCenter[i] + (at[i] < 0 ? -body.halfExtents[i] : body.halfExtents[i]);
    }
  } else {
    const auto b = static_cast<std::size_t>(contact.b.body());
    const BoxAt boxA = boxAt(pose, body);
    const BoxAt boxB = boxAt(encounter.after[b].pose, *mover(encounter.ranks[b]).body);
    feature = featureAt({contact.armA, contact.armB, contact.normal, contact.inCone},
                        gapAlong(boxA, boxB, contact.normal), contact.a, boxA, contact.b.body(), boxB);
    feature.axes = feature.a == contact.a ? contact.axes : swapped(contact.axes);
  }
  feature.material = contact.material;
  return feature;
}

// Begins the island's motion; returns whether it rests. One that goes on by time steps tries smooth motion
// only if nearly at rest: `slow` [m/s] is fallSpeed().
bool ExactWorld::beginsAtRest(Island& island, int timeSteps, double slow) const {
  double speed = 0;
  for (const TouchingBody& body : island.bodies()) {
    speed = std::max({speed, body.velocity.norm(), body.angularVelocityBody.norm() * radiusOf(*body.body)});
  }
  if (timeSteps == 0 || speed <= kAllButStill * slow) {
    island.begin();
    if (timeSteps == 0 || island.rests()) {
      return island.rests();
    }
  }
  island.beginTimeSteps(timeSteps);
  return false;
}

// The persisting contacts of an island's members. `indices` are its bodies: they, and what they touch.
std::vector<ContactFeature> ExactWorld::featuresOf(const Encounter& encounter,
                                                   const std::vector<std::size_t>& members,
                                                   std::vector<std::size_t>& indices) const {
  indices = members;
  std::vector<ContactFeature> features;
  const auto placeOf = [&](int index) {
    const auto at = std::find(indices.begin(), indices.end(), static_cast<std::size_t>(index));
    if (at == indices.end()) {
      indices.push_back(static_cast<std::size_t>(index));
      return static_cast<int>(indices.size()) - 1;
    }
    return static_cast<int>(at - indices.begin());
  };
  for (std::size_t k = 0; k < encounter.contacts.size(); ++k) {
    const ImpactContact& contact = encounter.contacts[k];
    const auto isMember = [&](int index) {
      return std::find(members.begin(), members.end(), static_cast<std::size_t>(index)) != members.end();
    };
    if (encounter.persists[k] == 0 ||
        (!isMember(contact.a) && (contact.b.isWall() || !isMember(contact.b.body())))) {
      continue;
    }
    ContactFeature feature = featureOf(encounter, k);
    feature.a = placeOf(feature.a);
    if (!feature.b.isWall()) {
      feature.b = Partner::ofBody(placeOf(feature.b.body()));
    }
    features.push_back(feature);
  }
  return features;
}

// Bodies joined by persisting contacts continue in Contact, unless no contact is active or nothing moves.
void ExactWorld::formIsland(Encounter& encounter, const std::vector<std::size_t>& members) const {
  std::vector<std::size_t> indices;
  std::vector<ContactFeature> features = featuresOf(encounter, members, indices);
  const bool forced = std::any_of(members.begin(), members.end(),
                                  [&](std::size_t i) { return isForced(encounter.ranks[i]); });
  const auto all = [&](Next next) {
    for (const std::size_t i : members) {
      encounter.next[i] = next;
    }
  };
  if (features.empty() && !forced && encounter.timeSteps == 0) {
    all(Next::kFlies);
    return;
  }
  std::vector<TouchingBody> bodies;
  std::vector<int> ranks;
  for (const std::size_t i : indices) {
    bodies.push_back(touchingBody(encounter, i));
    ranks.push_back(encounter.ranks[i]);
  }
  auto contactGroup = std::make_shared<ContactGroup>();
  const auto islandOfThem = [&] {
    return std::make_unique<Island>(world_, bodies, features, tolerance_, timeScale_);
  };
  contactGroup->island = islandOfThem();
  contactGroup->ranks = std::move(ranks);
  // Many bodies that nothing pulls may slide along each other without a force. Those that only springs join
  // have no contact that could change.
  const bool isMany = encounter.timeSteps == 0 && !features.empty() && members.size() > kMostSmooth;
  const bool isPulled = forced || encounter.pull > 0;
  const int timeSteps = isMany && isPulled ? kTimeStepsOfMany : encounter.timeSteps;
  const double slow = fallSpeed(encounter);
  bool rests = beginsAtRest(*contactGroup->island, timeSteps, slow);
  if (isMany && !isPulled && (contactGroup->island->pushes() || !contactGroup->island->isSmooth())) {
    contactGroup->island->beginTimeSteps(kTimeStepsOfMany);
    rests = false;
  }
  if (!rests && contactGroup->island->dropIdle(features)) {
    contactGroup->island = islandOfThem();
    rests = beginsAtRest(*contactGroup->island, timeSteps, slow);
  }
  if (timeSteps == 0 && encounter.cause == EventKind::kTouching && encounter.pull > 0 &&
      fastestChange(bodies, contactGroup->island->bodies()) > kMostTaken * slow) {
    contactGroup->island = islandOfThem();  // as they were before their hops were left out
    contactGroup->island->beginTimeSteps(kTimeStepsOfHops);
    rests = false;
  }
  Island& island = *contactGroup->island;
  encounter.residuals.add(island.takeResiduals());
  if (rests) {
    for (const std::size_t i : members) {
      const Mover& body = mover(encounter.ranks[i]);
      if (body.moves() || !movesAlike(encounter.before[i], encounter.after[i])) {
        encounter.next[i] = Next::kRests;
        encounter.after[i] = {.pose = encounter.after[i].pose};
      } else {
        encounter.next[i] = Next::kGoesOn;
      }
    }
  } else if (island.isSmooth() && !island.pushes() && !forced && encounter.cause != EventKind::kTouching) {
    all(Next::kFlies);
  } else {
    all(Next::kTouches);
    encounter.isTooMany = encounter.isTooMany || isTooMany(static_cast<int>(members.size()));
    encounter.islands.push_back(std::move(contactGroup));
  }
}

}  // namespace careen
