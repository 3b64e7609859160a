#include "physics/exact/crowd_meetings.h"

#include <gtest/gtest.h>

#include "physics/exact/encounter.h"
#include "support/started_bodies.h"

namespace careen {
namespace {

using test::crowdOf;
using test::cube;
using test::held;
using test::onFloor;
using test::StartedBodies;

TEST(CrowdMeetings, restAndFlySinceAMoment) {
  StartedBodies all(onFloor({cube("a", {0, 0, 5}), cube("b", {9, 0, 0.5})}));
  all.bodies.rest(1, Instant(2), all.bodies[1].body->initial.pose);
  EXPECT_TRUE(restsOnlySince(all.bodies[1], Instant(1)));
  EXPECT_FALSE(restsOnlySince(all.bodies[1], Instant(2)));
  EXPECT_FALSE(restsOnlySince(all.bodies[0], Instant(0)));
  EXPECT_TRUE(fliesSince(all.bodies, all.bodies[0], Instant(0)));
  EXPECT_FALSE(fliesSince(all.bodies, all.bodies[1], Instant(3)));
}

// A space of 1 m about the origin. The radius of a cube is ½√3 = .87 m.
TEST(CrowdMeetings, outsidersAreThoseWhoMayGetThere) {
  StartedBodies all(
      onFloor({cube("a", {0, 0, 40.5}), cube("b", {0, 0, 41.5}, {0.1, 0, 0}),
               cube("c", {3, 0, 0}, {-2, 0, 0}), cube("d", {3, 0, 0}), held(cube("e", {0, 1.8, 0}))}));
  const std::shared_ptr<CrowdGroup> crowd = crowdOf(all, 0);
  const Crowd::Extent space{.low = Vec3::Constant(-1), .high = Vec3::Constant(1)};
  const auto found = [&](double length) {
    return outsidersIn(all.bodies, *crowd, space, Instant(0), length, Outsiders::kAll);
  };
  EXPECT_EQ(found(0.2), (std::vector<int>{4}));
  EXPECT_EQ(found(0.3), (std::vector<int>{2, 4}));     // 2 m/s · .3 s + 10 m/s² · .3² s²
  EXPECT_EQ(found(0.4), (std::vector<int>{2, 3, 4}));  // 10 m/s² · .4² s² alone
}

// One that comes down at 20 m/s from 1 m above the upper member, which stays.
TEST(CrowdMeetings, ofTheNextStepAreSearchedFor) {
  StartedBodies all(onFloor({cube("a", {0, 0, 0.5}), cube("b", {0, 0, 1.5}, {0.1, 0, 0}),
                             cube("c", {0, 0, 3.5}, {0, 0, -20}), cube("d", {5, 0, 1.5}, {0, 0, 1})}));
  const std::shared_ptr<CrowdGroup> crowd = crowdOf(all, 0);
  EXPECT_FALSE(meetsNext(all.bodies, *crowd, 2, Instant(0), 0.04));
  EXPECT_TRUE(meetsNext(all.bodies, *crowd, 2, Instant(0), 0.06));
  EXPECT_FALSE(meetsNext(all.bodies, *crowd, 3, Instant(0), 0.06));
}

// Crowds of two and of three boxes, 2 cm apart. In .06 s they may come nearer by .06 s (.1 m/s + .6 m/s) =
// 4.2 cm, in .012 s by 3 mm. The larger one looks so far ahead; the smaller one leaves it to that.
TEST(CrowdMeetings, ofCrowdsTheLargerOneLooksAhead) {
  StartedBodies all(onFloor({cube("a", {0, 0, 0.5}), cube("b", {0, 0, 1.5}, {0, 0.1, 0}),
                             cube("c", {1.02, 0, 0.5}), cube("d", {1.02, 0, 1.5}),
                             cube("e", {1.02, 0, 2.5}, {0, 0.1, 0}), cube("f", {2.04, 0, 0.5})}));
  const std::shared_ptr<CrowdGroup> larger = crowdOf(all, 2);
  const std::shared_ptr<CrowdGroup> smaller = crowdOf(all, 0);
  ASSERT_NE(larger, smaller);
  EXPECT_TRUE(meetsNext(all.bodies, *larger, 1, Instant(0), 0.06 / kStepsAhead));
  EXPECT_FALSE(meetsNext(all.bodies, *larger, 1, Instant(0), 0.012 / kStepsAhead));
  EXPECT_FALSE(meetsNext(all.bodies, *smaller, 3, Instant(0), 0.06 / kStepsAhead));
  EXPECT_FALSE(meetsNext(all.bodies, *larger, 5, Instant(0), 0.06 / kStepsAhead));  // of no crowd
}

// Of a step of some milliseconds: a neighbour at rest, 1e-5 m from one that comes along at 1 m/s.
TEST(CrowdMeetings, ofTheStepTakenWereMet) {
  StartedBodies all(onFloor({cube("a", {0, 0, 0.5}), cube("b", {0, 0, 1.5}, {1, 0, 0}),
                             cube("c", {1.00001, 0, 1.5}), cube("d", {0, 1.1, 1.5})}));
  for (const int rank : {2, 3}) {
    all.bodies.rest(rank, Instant(0), all.bodies[rank].body->initial.pose);
  }
  const std::shared_ptr<CrowdGroup> crowd = crowdOf(all, 0);
  EXPECT_TRUE(crowd->has(all.bodies[2]));  // it was met, and admitted
  EXPECT_FALSE(crowd->has(all.bodies[3]));
  EXPECT_FALSE(wasMet(all.bodies, *crowd, 3, Instant(0)));
}

// One that leaves at 1 m/s, 1 mm above, comes no nearer, but is near for a while.
TEST(CrowdMeetings, areLookedForByWhoFliesNearby) {
  StartedBodies all(onFloor({cube("a", {0, 0, 0.5}), cube("b", {0, 0, 1.5}, {0.1, 0, 0}),
                             cube("c", {0, 0, 2.501}, {0, 0, 1}), cube("d", {0, 0, 9})}));
  const std::shared_ptr<CrowdGroup> crowd = crowdOf(all, 0);
  EXPECT_FALSE(crowd->has(all.bodies[2]));
  EXPECT_EQ(nearStep(all.bodies, *crowd), std::vector<int>{2});
}

}  // namespace
}  // namespace careen
