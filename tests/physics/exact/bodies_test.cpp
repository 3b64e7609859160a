#include "physics/exact/bodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "core/error.h"
#include "support/started_bodies.h"
#include "support/tumbling_box.h"

namespace careen {
namespace {

using test::afloat;
using test::cube;
using test::onFloor;
using test::StartedBodies;

TEST(Bodies, areInTheOrderOfTheirNames) {
  StartedBodies all(afloat({cube("b", {5, 0, 0}), cube("a", {0, 0, 0})}));
  EXPECT_EQ(all.bodies[0].body->name, "a");
  EXPECT_EQ(all.bodies[0].listed.value, 1);
  EXPECT_EQ(all.bodies[1].rank, 1);
}

// 4 m between their faces, at 2 and 1 m/s towards each other.
TEST(Bodies, queueTheirNextMeeting) {
  StartedBodies all(afloat({cube("a", {0, 0, 0}, {2, 0, 0}), cube("b", {5, 0, 0}, {-1, 0, 0})}));
  all.bodies.predict(0);
  const std::optional<Event> event = all.bodies.queue().next();
  ASSERT_TRUE(event.has_value());
  EXPECT_NEAR(event->time.hi, 4.0 / 3, 1e-14);
  EXPECT_EQ(event->partner, 1);
  EXPECT_EQ(event->partnerMotion, all.bodies[1].motion);
}

// The floor is met after sqrt(2 · 20/10) s.
TEST(Bodies, thatFlyAreRecordedAndMeetWalls) {
  StartedBodies all(onFloor({cube("a", {0, 0, 20.5})}));
  ASSERT_EQ(all.memory.moved.size(), 1U);
  all.bodies.predict(0);
  EXPECT_NEAR(all.bodies.queue().next()->time.hi, 2, 1e-14);
}

TEST(Bodies, atRestQueueNothing) {
  StartedBodies all(onFloor({cube("a", {0, 0, 0.5})}));
  all.bodies.predict(0);
  all.bodies.rest(0, Instant(1), all.bodies[0].body->initial.pose);
  all.bodies.predict(0);
  EXPECT_FALSE(all.bodies.queue().next().has_value());
  EXPECT_TRUE(std::holds_alternative<Rest>(all.memory.moved.back().motion));
}

TEST(Bodies, doNotMoveEndlesslyAtOneMoment) {
  StartedBodies all(afloat({cube("a", {0, 0, 0})}));
  const Pose pose = all.bodies[0].body->initial.pose;
  for (int k = 0; k < 2 * Bodies::kMostAtOneMoment; ++k) {
    all.bodies.rest(0, Instant(1e-3 * k), pose);  // time passes
  }
  for (int k = 0; k < 2 * Bodies::kMostAtOneMoment; ++k) {
    all.bodies.rest(0, Instant(9), pose);
  }
  all.bodies.rest(0, Instant(9), pose);
  EXPECT_THROW(all.bodies.rest(0, Instant(9), pose), NumericalError);
}

TEST(Bodies, standForAWhileThatHasALength) {
  StartedBodies all(onFloor({cube("a", {0, 0, 0.5})}));
  const std::size_t before = all.memory.moved.size();
  all.bodies.stand(0, Instant(1), Instant(1), {0, 0, 0.5}, Quat::Identity());
  EXPECT_EQ(all.memory.moved.size(), before);
  all.bodies.stand(0, Instant(1), Instant(1.5), {0, 0, 0.5}, Quat::Identity());
  ASSERT_EQ(all.memory.moved.size(), before + 1);
  const BodyState state = stateAt(all.memory.moved.back().motion, all.bodies[0].body->mass, 0.25);
  EXPECT_EQ(state.pose.position, Vec3(0, 0, 0.5));
  EXPECT_EQ(state.velocity, Vec3::Zero());
}

TEST(Bodies, knowWhomSpringsJoinToThem) {
  World world = afloat({cube("a", {0, 0, 0}), cube("b", {5, 0, 0}), cube("c", {9, 0, 0})});
  world.springs = {{.from = {.body = 0, .point = Vec3::Zero()}, .to = {.body = 2, .point = Vec3::Zero()}}};
  StartedBodies all(world);
  EXPECT_TRUE(all.bodies.isForced(0));
  EXPECT_FALSE(all.bodies.isForced(1));
  ASSERT_EQ(all.bodies.joinedTo(2).size(), 1U);
  EXPECT_EQ(all.bodies.joinedTo(2)[0], 0);
}

TEST(Bodies, haveTheirImpactsRecordedByIndexInTheWorld) {
  StartedBodies all(afloat({cube("b", {5, 0, 0}), cube("a", {0, 0, 0})}));
  all.bodies.strike(Instant(3), 0, 1, {1, 2, 3}, {.approach = 4, .impulse = 5});
  ASSERT_EQ(all.memory.impacts.size(), 1U);
  const Impact& impact = all.memory.impacts[0];
  EXPECT_EQ(impact.a.value, 1);
  EXPECT_EQ(impact.b, Partner::ofBody(0));
  EXPECT_EQ(impact.point, Vec3(1, 2, 3));
  EXPECT_EQ(impact.impulse, 5);
  EXPECT_EQ(impact.approach, 4);
}

// Each of 16 or fewer shares what 16 have: one has it all.
TEST(Bodies, maySpendWhatTheirNumberGivesThem) {
  StartedBodies all(afloat({cube("a", {0, 0, 0})}));
  const std::vector<int> ranks = {0};
  EXPECT_EQ(all.bodies.workLeft(ranks, Instant(2)), 16 * (6e5 + 2 * 5e4));
  all.bodies[0].work = 1e6;
  EXPECT_EQ(all.bodies.workLeft(ranks, Instant(2)), 16 * (6e5 + 2 * 5e4) - 1e6);
  StartedBodies never(afloat({cube("a", {0, 0, 0})}), {.when = CrowdSettings::When::kNever});
  EXPECT_EQ(never.bodies.workLeft(ranks, Instant(2)), std::numeric_limits<double>::infinity());
}

World cubesAfloat(int count) {
  World world;
  for (int k = 0; k < count; ++k) {
    world.bodies.push_back(cube("box-" + std::to_string(100 + k), {3.0 * k, 0, 0}));
  }
  return world;
}

// Of 32 each has a quarter of what one of 16 has, and half of that when it is found that all move; only what
// each second gives in such doubt as a crowd is, if it touches another.
TEST(Bodies, maySpendLessWhereItIsWorthLess) {
  StartedBodies many(cubesAfloat(32));
  const std::vector<int> pair = {0, 1};
  EXPECT_EQ(many.bodies.workLeft(pair, Instant(2)), 2 * (6e5 + 2 * 5e4) / 4);
  many.bodies.fly(0, Instant(1), many.bodies[0].body->initial, Quat::Identity());
  EXPECT_EQ(many.bodies.workLeft(pair, Instant(2)), 2 * (6e5 + 2 * 5e4) / 8);
  many.bodies[1].doubt = {.place = 2e-4, .speed = 1e-4};
  EXPECT_EQ(many.bodies.workLeft(pair, Instant(0.5)), 2 * (6e5 + 0.5 * 5e4) / 8);
  EXPECT_EQ(many.bodies.workLeft(pair, Instant(2)), 2 * 2 * 5e4 / 8);
  many.bodies[0].work = 1e5;
  EXPECT_EQ(many.bodies.workLeft(pair, Instant(2)), 2 * 2 * 5e4 / 8 - 1e5);
  EXPECT_EQ(many.bodies.workLeft(std::vector<int>{1}, Instant(2)), (6e5 + 2 * 5e4) / 8);
  StartedBodies few(cubesAfloat(16));
  few.bodies[1].doubt.place = 1;
  EXPECT_EQ(few.bodies.workLeft(pair, Instant(2)), 2 * (6e5 + 2 * 5e4));
}

// A cube at rest 5 m from the origin, half diagonal √3/2: known to a rounding of both.
TEST(Bodies, areKnownToRoundingAtTheStart) {
  const StartedBodies all(afloat({cube("a", {0, 3, 4}), test::held(cube("b", {9, 0, 0}))}));
  const double radius = std::sqrt(3.0) / 2;
  EXPECT_DOUBLE_EQ(all.bodies[0].doubt.place, 0x1p-52 * (5 + radius));
  EXPECT_EQ(all.bodies[0].doubt.speed, 0);
  EXPECT_EQ(all.bodies[1].doubt.place, 0);
}

// Its doubt passes its radius after radius / speed.
TEST(Bodies, tellWhenAPlaceMeansNothing) {
  StartedBodies all(afloat({cube("a", {0, 0, 0})}));
  all.bodies[0].doubt = {.place = 0, .speed = 0.25};
  all.bodies.doubtAt(0, Instant(3));
  EXPECT_FALSE(all.bodies.account().figures().horizon);
  all.bodies.doubtAt(0, Instant(9));
  ASSERT_TRUE(all.bodies.account().figures().horizon);
  EXPECT_NEAR(*all.bodies.account().figures().horizon, std::sqrt(3.0) / 2 / 0.25, 1e-15);
}

TEST(Bodies, areTooManyWhereTheSceneSaysSo) {
  StartedBodies above(afloat({}), {.when = CrowdSettings::When::kAbove, .above = 3});
  EXPECT_FALSE(isTooMany(above.bodies, 3));
  EXPECT_TRUE(isTooMany(above.bodies, 4));
  StartedBodies automatic(afloat({}));
  EXPECT_FALSE(isTooMany(automatic.bodies, 16));
  EXPECT_TRUE(isTooMany(automatic.bodies, 17));
  StartedBodies never(afloat({}), {.when = CrowdSettings::When::kNever});
  EXPECT_FALSE(isTooMany(never.bodies, 1000));
}

// Ten cubes have cells of 8/7 of √3 m; without gravity the margin of 1/32 of that is crossed at that speed.
TEST(Bodies, stayInTheMarginOfTheirCellsForThatLong) {
  World world;
  for (int k = 0; k < 10; ++k) {
    world.bodies.push_back(cube("box-" + std::to_string(k), {3.0 * k, 0, 0}));
  }
  const StartedBodies all(world);
  const double margin = std::sqrt(3.0) * 8 / 7 / 32;
  EXPECT_NEAR(all.bodies.withinCell(2), margin / 2, 1e-15);
  EXPECT_EQ(all.bodies.withinCell(0), all.bodies.longestStep());
}

// 400 flights: who gets into a space within a while is known from samples of all of them.
TEST(Bodies, areFoundWhereTheyMayGet) {
  test::Dice dice(11);
  World world;
  world.gravity = Vec3(0, 0, -10);
  for (int k = 0; k < 400; ++k) {
    world.bodies.push_back(
        cube("box-" + std::to_string(100 + k), {1.5 * (k % 20), 0.075 * (k - k % 20), 0}, dice.vector(100)));
  }
  StartedBodies all(world);
  std::size_t hits = 0;
  std::size_t found = 0;
  for (int moment = 0; moment < 399; ++moment) {
    const double now = 1e-3 * moment;
    for (int rank = 0; rank < 400; ++rank) {  // as its crossings would
      all.bodies.file(rank, all.bodies[rank].positionAt(Instant(now)));
    }
    const double length = 0.01;
    const double from = now - dice.between(0, 1) * std::min(length, now);
    const Vec3 low = all.bodies[moment].positionAt(Instant(from + length)) + dice.vector(1.2);
    const std::vector<int> may = all.bodies.mayReach(low, low + Vec3::Ones(), Instant(from), length);
    for (int rank = 0; rank < 400; ++rank) {
      bool hit = false;
      for (int k = 0; k <= 10; ++k) {
        const Vec3 at = all.bodies[rank].positionAt(Instant(from + k * length / 10));
        hit = hit || (at.cwiseMax(low).cwiseMin(low + Vec3::Ones()) - at).norm() <= std::sqrt(0.75);
      }
      hits += hit ? 1 : 0;
      EXPECT_TRUE(!hit || std::binary_search(may.begin(), may.end(), rank)) << rank << ' ' << now;
    }
    found += may.size();
  }
  EXPECT_GT(hits, 100U);
  EXPECT_LT(found, 399U * 300);
}

}  // namespace
}  // namespace careen
