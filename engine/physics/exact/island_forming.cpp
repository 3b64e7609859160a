#include "physics/exact/island_forming.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "core/disjoint_sets.h"
#include "physics/contact/island.h"
#include "physics/exact/island_group.h"
#include "physics/geometry/separation.h"

namespace careen {
namespace {

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

ContactFeature featureOf(const Encounter& encounter, std::size_t k) {
  const ImpactContact& contact = encounter.contacts[k];
  if (contact.joint != ImpactContact::kNoJoint) {
    return encounter.joints[static_cast<std::size_t>(contact.joint)];
  }
  const EncounterBody& a = encounter.a(k);
  ContactFeature feature;
  if (!encounter.b(k).mover->isBox()) {
    feature = {.a = contact.a, .b = contact.b, .onA = corner(a.body(), contact.corner)};
  } else {
    const BoxAt boxA = boxAt(a.after.pose, a.body(), contact.boxA);
    const BoxAt boxB = boxAt(encounter.b(k).after.pose, encounter.b(k).body(), contact.boxB);
    feature = featureAt({contact.armA, contact.armB, contact.normal, contact.inCone},
                        gapAlong(boxA, boxB, contact.normal), contact.a, boxA, contact.b, boxB);
    feature.axes = feature.a == contact.a ? contact.axes : swapped(contact.axes);
  }
  feature.material = feature.a == contact.a ? contact.material : swapped(contact.material);
  return feature;
}

// Begins the island's motion; returns whether it rests. One that goes on by time steps tries smooth motion
// only if nearly at rest: `slow` [m/s] is fallSpeed().
bool beginsAtRest(Island& island, int timeSteps, double slow) {
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

// What an island is made of.
struct IslandParts {
  std::vector<std::size_t> indices;      // of its bodies: the members, what they touch, and walls
  std::vector<ContactFeature> features;  // the contacts of members that persist
  std::vector<ContactFeature> joints;    // all conditions of their joints
};

IslandParts partsOf(const Encounter& encounter, const std::vector<std::size_t>& members) {
  const std::size_t boxes = encounter.boxes().size();
  IslandParts parts;
  parts.indices = members;
  std::vector<std::size_t>& indices = parts.indices;
  std::vector<ContactFeature>& features = parts.features;
  const auto isMember = [&](int index) {
    return std::find(members.begin(), members.end(), static_cast<std::size_t>(index)) != members.end();
  };
  const auto placeOf = [&](int index) {
    return std::find(indices.begin(), indices.end(), static_cast<std::size_t>(index)) - indices.begin();
  };
  const auto include = [&](int index) {
    if (static_cast<std::size_t>(index) < boxes && placeOf(index) == std::ssize(indices)) {
      indices.push_back(static_cast<std::size_t>(index));
    }
  };
  for (std::size_t k = 0; k < encounter.contacts.size(); ++k) {
    const ImpactContact& contact = encounter.contacts[k];
    if (encounter.persists[k] == 0 || (!isMember(contact.a) && !isMember(contact.b))) {
      continue;
    }
    const ContactFeature& feature = features.emplace_back(featureOf(encounter, k));
    include(feature.a);
    include(feature.b);
  }
  for (const ContactFeature& joint : encounter.joints) {
    if (isMember(joint.a) || isMember(joint.b)) {
      parts.joints.push_back(joint);
      include(joint.a);
      include(joint.b);
      if (joint.grips()) {
        features.push_back(joint);
      }
    }
  }
  for (std::size_t wall = boxes; wall < encounter.bodies.size(); ++wall) {
    indices.push_back(wall);
  }
  for (std::vector<ContactFeature>* all : {&features, &parts.joints}) {
    for (ContactFeature& feature : *all) {
      feature.a = static_cast<int>(placeOf(feature.a));
      feature.b = static_cast<int>(placeOf(feature.b));
    }
  }
  return parts;
}

bool hasContacts(const std::vector<ContactFeature>& features) {
  return std::any_of(features.begin(), features.end(),
                     [](const ContactFeature& feature) { return !feature.isOfJoint(); });
}

void formIsland(Bodies& bodies, Encounter& encounter, const std::vector<std::size_t>& members) {
  IslandParts parts = partsOf(encounter, members);
  std::vector<ContactFeature>& features = parts.features;
  const bool forced = std::any_of(members.begin(), members.end(), [&](std::size_t i) {
    return bodies.isForced(encounter.bodies[i].mover->rank);
  });
  const auto all = [&](NextMotion next) {
    for (const std::size_t i : members) {
      encounter.bodies[i].next = next;
    }
  };
  if (features.empty() && !forced && encounter.timeSteps == 0) {
    all(NextMotion::kFlies);
    return;
  }
  std::vector<TouchingBody> touching;
  std::vector<int> ranks;
  for (const std::size_t i : parts.indices) {
    touching.push_back(encounter.bodies[i].touching(encounter.time));
    ranks.push_back(encounter.bodies[i].mover->rank);
  }
  const auto islandOfThem = [&] {
    return std::make_unique<Island>(bodies.world(), touching, features, bodies.tolerance(),
                                    bodies.timeScale(), parts.joints);
  };
  std::unique_ptr<Island> island = islandOfThem();
  // Many bodies that nothing pulls may slide along each other without a force. Those that only springs or
  // joints connect have no contact that could change.
  const bool isMany = encounter.timeSteps == 0 && hasContacts(features) && members.size() > kMostSmooth;
  const bool isPulled = forced || encounter.pull > 0;
  const int timeSteps = isMany && isPulled ? kTimeStepsOfMany : encounter.timeSteps;
  const double slow = fallSpeed(bodies, encounter);
  bool rests = beginsAtRest(*island, timeSteps, slow);
  if (isMany && !isPulled && (island->pushes() || !island->isSmooth())) {
    island->beginTimeSteps(kTimeStepsOfMany);
    rests = false;
  }
  if (!rests && island->dropIdle(features)) {
    island = islandOfThem();
    rests = beginsAtRest(*island, timeSteps, slow);
  }
  if (timeSteps == 0 && encounter.cause == EventKind::kTouching && encounter.pull > 0 &&
      fastestChange(touching, island->bodies()) > kMostTaken * slow) {
    island = islandOfThem();  // as they were before their hops were left out
    island->beginTimeSteps(kTimeStepsOfHops);
    rests = false;
  }
  encounter.residuals.add(island->takeResiduals());
  if (rests) {
    for (const std::size_t i : members) {
      EncounterBody& body = encounter.bodies[i];
      if (body.mover->moves() || !movesAlike(body.before, body.after)) {
        body.next = NextMotion::kRests;
        body.after = {.pose = body.after.pose};
      } else {
        body.next = NextMotion::kGoesOn;
      }
    }
  } else if (island->isSmooth() && !island->pushes() && !forced && encounter.cause != EventKind::kTouching) {
    all(NextMotion::kFlies);
  } else {
    all(NextMotion::kSteps);
    encounter.islands.push_back(std::make_shared<IslandGroup>(bodies, std::move(ranks), std::move(island)));
  }
}

}  // namespace

void formIslands(Bodies& bodies, Encounter& encounter) {
  const std::size_t count = encounter.bodies.size();
  DisjointSets joined(count);
  const auto takesPart = [&](std::size_t i) {
    return !encounter.bodies[i].mover->isHeld() && encounter.bodies[i].next != NextMotion::kRests;
  };
  const auto joinBoth = [&](std::size_t i, std::size_t j) {
    if (takesPart(i) && takesPart(j)) {
      joined.join(i, j);
    }
  };
  for (std::size_t k = 0; k < encounter.contacts.size(); ++k) {
    if (encounter.persists[k] != 0) {
      joinBoth(encounter.indexA(k), encounter.indexB(k));
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i + 1; encounter.timeSteps > 0 && j < count; ++j) {
      if (takesPart(i) && takesPart(j) &&
          mayTouch(bodies.world(), encounter.bodies[i].listed(), encounter.bodies[j].listed()) &&
          areTouching(encounter.bodies[i], encounter.bodies[j], nearness(bodies, encounter))) {
        joined.join(i, j);
      }
    }
    for (const int other : bodies.joinedTo(encounter.bodies[i].mover->rank)) {
      joinBoth(i, encounter.indexOf(other));
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
      formIsland(bodies, encounter, members);
    }
  }
}

}  // namespace careen
