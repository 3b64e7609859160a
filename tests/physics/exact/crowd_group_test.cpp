#include "physics/exact/crowd_group.h"

#include <gtest/gtest.h>

#include "physics/exact/encounter.h"
#include "support/started_bodies.h"

namespace careen {
namespace {

using test::afloat;
using test::crowdOf;
using test::cube;
using test::onFloor;
using test::StartedBodies;

TEST(CrowdGroup, hasTheBodiesOfAnEncounter) {
  StartedBodies all(
      onFloor({cube("a", {0, 0, 0.5}), cube("b", {0, 0, 1.5}, {0.5, 0, 0}), cube("c", {9, 0, 0.5})}));
  const std::shared_ptr<CrowdGroup> crowd = crowdOf(all, 0);
  ASSERT_NE(crowd, nullptr);
  EXPECT_TRUE(crowd->has(all.bodies[1]));
  EXPECT_FALSE(crowd->has(all.bodies[2]));
  EXPECT_TRUE(all.bodies[1].steps());
  EXPECT_EQ(all.bodies[1].doubt.place, 3e-4);  // its tolerance
  EXPECT_EQ(crowd->start().hi, 0);
  EXPECT_GT(crowd->length(), 0);
  EXPECT_EQ(all.bodies.queue().next()->kind, EventKind::kStep);
}

// One on a spring comes along, once, though it touches nothing.
TEST(CrowdGroup, hasWhomSpringsJoin) {
  World world = onFloor({cube("a", {0, 0, 0.5}, {0.5, 0, 0}), cube("b", {0, 0, 5})});
  world.springs = {{.from = {.body = 0, .point = Vec3::Zero()}, .to = {.body = 1, .point = Vec3::Zero()}}};
  StartedBodies all(world);
  const std::shared_ptr<CrowdGroup> crowd = crowdOf(all, 0);
  EXPECT_EQ(crowd->ranks(), (std::vector<int>{-1, 0, 1}));  // the floor has the first place
}

// Without friction the upper one slides at ½ m/s, whatever the steps.
TEST(CrowdGroup, movesThemFromStepToStep) {
  StartedBodies all(onFloor({cube("a", {0, 0, 0.5}), cube("b", {0, 0, 1.5}, {0.5, 0, 0})}));
  const std::shared_ptr<CrowdGroup> crowd = crowdOf(all, 0);
  for (int k = 0; k < 20; ++k) {
    ASSERT_TRUE(crowd->goesOn());
    EXPECT_FALSE(crowd->advance(crowd->end()).has_value());
  }
  const double x = all.bodies[1].stateAt(crowd->end()).pose.position.x();
  EXPECT_NEAR(x, 0.5 * crowd->end().hi, 1e-8);
}

TEST(CrowdGroup, takesAnEncounterOverInsteadOfEnteringIt) {
  StartedBodies all(onFloor({cube("a", {0, 0, 0.5}), cube("b", {0, 0, 1.5}, {0.5, 0, 0})}));
  const std::shared_ptr<CrowdGroup> crowd = crowdOf(all, 0);
  Encounter encounter;
  join(all.bodies, encounter, 0);
  join(all.bodies, encounter, 1);
  EXPECT_TRUE(encounter.bodies.empty());
  ASSERT_EQ(encounter.crowds.size(), 1U);
  EXPECT_EQ(encounter.crowds[0], crowd);
}

// Two that part in space: what nothing is near goes on in Flight, as it came.
TEST(CrowdGroup, letsGoWhatNothingTouches) {
  StartedBodies all(afloat({cube("a", {0, 0, 0}, {-1, 0, 0}), cube("b", {1, 0, 0}, {1, 0, 0})}));
  const std::shared_ptr<CrowdGroup> crowd = crowdOf(all, 0);
  int steps = 0;
  while (all.bodies[0].group && ++steps < 1000) {
    crowd->advance(crowd->end());
  }
  EXPECT_TRUE(all.bodies[0].flies());
  EXPECT_EQ(all.bodies[0].flight.velocity, Vec3(-1, 0, 0));
}

// They fall asleep as members, and leave when all of them are.
TEST(CrowdGroup, leavesAtRestWhatHasFallenAsleep) {
  StartedBodies all(onFloor({cube("a", {0, 0, 0.5}), cube("b", {0, 0, 1.5})}, 0.5));
  const std::shared_ptr<CrowdGroup> crowd = crowdOf(all, 0);
  int steps = 0;
  while (all.bodies[0].group && ++steps < 1000) {
    crowd->advance(crowd->end());
  }
  EXPECT_FALSE(all.bodies[0].moves());
  EXPECT_NEAR(all.bodies[1].pose.position.z(), 1.5, 3e-4);
  EXPECT_TRUE(std::holds_alternative<Rest>(all.memory.moved.back().motion));
}

// Two crowds whose bodies meet are one.
TEST(CrowdGroup, takesInAnotherOne) {
  const Vec3 left(-1, 0, 0);
  StartedBodies all(onFloor({cube("a", {0, 0, 0.5}), cube("b", {0, 0, 1.5}, {1, 0, 0}),
                             cube("c", {3, 0, 0.5}), cube("d", {3, 0, 1.5}, left)}));
  const std::shared_ptr<CrowdGroup> crowd = crowdOf(all, 0);
  const std::shared_ptr<CrowdGroup> other = crowdOf(all, 2);
  ASSERT_NE(crowd, other);
  Encounter encounter;
  encounter.time = Instant(crowd->length() / 2);
  join(all.bodies, encounter, 1);
  join(all.bodies, encounter, 3);
  CrowdGroup::form(all.bodies, encounter);
  EXPECT_EQ(all.bodies[0].group, all.bodies[2].group);
  EXPECT_EQ(all.bodies[1].group, all.bodies[3].group);
  EXPECT_EQ(all.bodies[0].group->start().hi, encounter.time.hi);
}

// Two are 5 mm from three, and may come nearer than that in some steps. They begin within the step of those,
// and do not cut it: they are taken in when it ends.
TEST(CrowdGroup, takesInASmallerOneBetweenSteps) {
  StartedBodies all(
      onFloor({cube("a", {0, 0, 0.5}), cube("b", {0, 0, 1.5}, {0, 0.1, 0}), cube("c", {1.005, 0, 0.5}),
               cube("d", {1.005, 0, 1.5}), cube("e", {1.005, 0, 2.5}, {0, 0.1, 0})}));
  const std::shared_ptr<CrowdGroup> larger = crowdOf(all, 2);
  const double length = larger->length();
  const std::shared_ptr<CrowdGroup> smaller = crowdOf(all, 0);
  ASSERT_NE(larger, smaller);
  EXPECT_EQ(larger->length(), length);
  const Instant end = larger->end();
  larger->advance(end);
  EXPECT_TRUE(larger->has(all.bodies[0]) && larger->has(all.bodies[1]));
  EXPECT_EQ(larger->start().hi, end.hi);
}

// Of three crowds that meet the last falls asleep then, at which others may look around, while members of the
// second are in the first already: all are somewhere.
TEST(CrowdGroup, knowsWhereMembersTakenInAre) {
  StartedBodies all(
      onFloor({cube("a", {0, 0, 0.5}), cube("b", {0, 0, 1.5}, {0.1, 0, 0}), cube("c", {2.5, 0, 0.5}),
               cube("d", {2.5, 0, 1.5}, {0.1, 0, 0}), cube("e", {5, 0, 0.5}, {0, 0, 0}, {.friction = 0.5}),
               cube("f", {5, 0, 1.5}, {0, 0, 0}, {.friction = 0.5})},
              0.5));
  const std::shared_ptr<CrowdGroup> first = crowdOf(all, 0);
  const std::shared_ptr<CrowdGroup> second = crowdOf(all, 2);
  const std::shared_ptr<CrowdGroup> last = crowdOf(all, 4);
  for (int steps = 0; !last->crowd().sleeps(1) && steps < 100; ++steps) {
    for (CrowdGroup* group : {first.get(), second.get(), last.get()}) {
      group->advance(group->end());
    }
  }
  Encounter encounter;
  encounter.time = last->end();
  for (const int rank : {0, 2, 4}) {
    join(all.bodies, encounter, rank);
  }
  ASSERT_EQ(encounter.crowds.size(), 3U);
  int asked = 0;
  all.memory.onMove = [&] {
    for (int rank = 0; rank < all.bodies.count(); ++rank) {
      EXPECT_TRUE(all.bodies[rank].positionAt(encounter.time).allFinite()) << rank;
      asked += all.bodies[rank].steps() && all.bodies[rank].group == encounter.crowds[0] ? 1 : 0;
    }
  };
  CrowdGroup::form(all.bodies, encounter);
  EXPECT_GT(asked, 3);
}

}  // namespace
}  // namespace careen
