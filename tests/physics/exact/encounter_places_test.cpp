#include "physics/exact/encounter_places.h"

#include <gtest/gtest.h>

#include "physics/exact/island_group.h"
#include "support/started_bodies.h"

namespace careen {
namespace {

using test::cube;
using test::onFloor;
using test::StartedBodies;

Encounter displaced(StartedBodies& all, const Event& event, double by) {
  Encounter encounter = gather(all.bodies, event);
  for (EncounterBody& body : encounter.bodies) {
    body.before.pose.position.z() -= by;
    body.after = body.before;
  }
  alignPlaces(all.bodies, event, encounter);
  return encounter;
}

// A cube that slides on the floor, and is found 1e-9 m deep in it.
TEST(EncounterPlaces, areWhereContactsOfAGroupTouch) {
  StartedBodies all(onFloor({cube("a", {0, 0, 0.5}, {3, 0, 0})}));
  const std::shared_ptr<IslandGroup> island = all.settled(0).islands.at(0);
  island->begin(Instant(0));
  const Event event{.time = island->end(), .kind = EventKind::kStep, .body = 0};
  const Encounter encounter = displaced(all, event, 1e-9);
  EXPECT_NEAR(encounter.bodies[0].before.pose.position.z(), 0.5, 1e-15);
  EXPECT_EQ(encounter.bodies[0].after.pose.position, encounter.bodies[0].before.pose.position);
}

// Flights are exact.
TEST(EncounterPlaces, ofFlightsStayAsTheyAre) {
  StartedBodies all(onFloor({cube("a", {0, 0, 0.5})}));
  const Event event{.time = Instant(0), .kind = EventKind::kContact, .body = 0};
  const Encounter encounter = displaced(all, event, 1e-9);
  EXPECT_EQ(encounter.bodies[0].before.pose.position.z(), 0.5 - 1e-9);
}

// One slides on the other: both are moved, by no more than three tolerances.
TEST(EncounterPlaces, areNotFarFromWhereTheyWere) {
  StartedBodies all(onFloor({cube("a", {0, 0, 0.5}), cube("b", {0, 0, 1.5}, {0.5, 0, 0})}));
  const std::shared_ptr<IslandGroup> island = all.settled(0).islands.at(0);
  island->begin(Instant(0));
  const Event event{.time = island->end(), .kind = EventKind::kStep, .body = 1};
  const Encounter deep = displaced(all, event, 1e-4);
  EXPECT_LE(deep.bodies[0].before.pose.position.z(), 0.5 - 1e-4 + 3 * 1e-6);
  const Encounter shallow = displaced(all, event, 1e-7);
  EXPECT_NEAR(shallow.bodies[0].before.pose.position.z(), 0.5, 1e-15);
  EXPECT_NEAR(shallow.bodies[1].before.pose.position.z(), 1.5, 1e-15);
}

}  // namespace
}  // namespace careen
