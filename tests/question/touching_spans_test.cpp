#include "question/touching_spans.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "support/asked_runs.h"
#include "support/exact_runs.h"
#include "support/trajectories.h"

namespace careen {
namespace {

using test::kG;
using test::runOf;

constexpr double kNear = 4.001e-6;  // [m] 4 tolerances of 1e-6 and 1e-9
const Partner kFloor = Partner::ofWall(0);

std::vector<TrueSpan> spansIn(const Trajectory& run, std::size_t body, Partner with) {
  return touchingSpans(run, body, with, run.settings.duration);
}

// A cube falls flat by 0.45 m on a floor of restitution e = 0.6: impact 0 at √(2h/g), each of the next 2 v
// eᵏ/g later: at 0.303, 0.666, 0.884 and 1.015 s; where v = √(2gh). It touches from the impact until it is
// kNear above the floor.
TEST(TouchingSpans, ofABouncingBoxBeginAtItsImpacts) {
  World world;
  world.gravity = Vec3(0, 0, -kG);
  world.bodies = {box("a", Vec3::Constant(0.05), 1, Vec3(0, 0, 0.5), Vec3::Zero(), Vec3::Zero(), 0.6)};
  world.walls = {wall("floor", Vec3::UnitZ(), 0, 0)};
  const Trajectory run = runOf(world, 1.05);
  const std::vector<TrueSpan> spans = spansIn(run, 0, kFloor);
  const double speed = std::sqrt(2 * kG * 0.45);
  std::set<double> times;
  for (const Impact& impact : run.impacts) {
    times.insert(impact.time);
  }
  ASSERT_EQ(spans.size(), 4U);
  ASSERT_EQ(std::vector(times.begin(), times.end()).size(), 4U);
  double expected = std::sqrt(0.9 / kG);
  double after = 0.6 * speed;
  auto impact = times.begin();
  for (const TrueSpan& span : spans) {
    EXPECT_EQ(span.from, *impact++);
    EXPECT_NEAR(span.from, expected, 1e-13);
    EXPECT_NEAR(span.to - span.from, (after - std::sqrt(after * after - 2 * kG * kNear)) / kG, 1e-14);
    expected += 2 * after / kG;
    after *= 0.6;
  }
}

// G. Galperin's billiard: a box of 10,000 times the mass strikes one before a wall, all elastic; there are
// 314 impacts, every other one of the two.
TEST(TouchingSpans, areAsManyAsTheDigitsOfPi) {
  World world;
  world.walls = {wall("wall", Vec3::UnitX(), 0)};
  world.bodies = {box("light", Vec3::Constant(0.1), 1, Vec3(1, 0, 0)),
                  box("heavy", Vec3::Constant(0.1), 1e4, Vec3(2, 0, 0), Vec3(-1, 0, 0))};
  const Trajectory run = runOf(world, 10);
  EXPECT_EQ(spansIn(run, 0, Partner::ofBody(1)).size(), 157U);
  EXPECT_EQ(spansIn(run, 0, Partner::ofWall(0)).size(), 157U);
  EXPECT_EQ(spansIn(run, 1, Partner::ofWall(0)).size(), 0U);
}

// With their middles 0.3 m apart in y they are 0.1 m apart; 5e-6 m apart is above kNear, 3e-6 m is not.
TEST(TouchingSpans, ofBoxesThatPassEachOtherAreWhereTheyAreNear) {
  for (const double speed : {2.0, 7.0}) {
    for (const auto& [apart, touches] : {std::pair(0.1, false), {5e-6, false}, {3e-6, true}}) {
      World world;
      world.bodies = {box("a", Vec3::Constant(0.1), 1, Vec3(-1, 0.2 + apart, 0), Vec3(speed, 0, 0)),
                      box("b", Vec3::Constant(0.1), 1, Vec3(0, 0, 0))};
      const Trajectory run = runOf(world, 1);
      ASSERT_TRUE(run.impacts.empty());
      const std::vector<TrueSpan> spans = spansIn(run, 0, Partner::ofBody(1));
      ASSERT_EQ(spans.size(), touches ? 1U : 0U) << apart;
      if (touches) {
        // From 0.2 m before the other's middle to 0.2 m behind it, and kNear more at each end.
        EXPECT_NEAR(spans[0].from, (0.8 - kNear) / speed, 1e-12);
        EXPECT_NEAR(spans[0].to, (1.2 + kNear) / speed, 1e-12);
      }
    }
  }
}

// Slides without weight at 1 m/s on a table whose edge is 0.7 m before its last corner.
TEST(TouchingSpans, ofABoxThatLeavesALedgeEndAtTheLedge) {
  World world;
  Body table = box("table", Vec3(1, 1, 0.1), 1, Vec3(0, 0, -0.1));
  table.mass = immovable();
  world.bodies = {box("a", Vec3::Constant(0.1), 1, Vec3(0.4, 0, 0.1), Vec3(1, 0, 0), Vec3::Zero(), 0), table};
  const Trajectory run = runOf(world, 2);
  const std::vector<TrueSpan> spans = spansIn(run, 0, Partner::ofBody(1));
  ASSERT_EQ(spans.size(), 1U);
  EXPECT_EQ(spans[0].from, 0);
  EXPECT_NEAR(spans[0].to, 0.7 + kNear, 1e-12);
}

// It lies on the floor from the start, is pushed by a spring for a while, and never leaves it.
TEST(TouchingSpans, ofABoxThatSlidesLastUntilItRestsAndAfter) {
  World world;
  world.gravity = Vec3(0, 0, -kG);
  Body slider = box("a", Vec3(0.2, 0.1, 0.05), 1, Vec3(0, 0, 0.05), Vec3(2, 0, 0), Vec3::Zero(), 0);
  slider.material.friction = 0.4;
  world.bodies = {slider};
  world.walls = {wall("floor", Vec3::UnitZ(), 0, 0)};
  world.walls[0].material.friction = 0.4;
  const Trajectory run = runOf(world, 1);
  const std::vector<TrueSpan> spans = spansIn(run, 0, kFloor);
  ASSERT_EQ(spans.size(), 1U);
  EXPECT_EQ(spans[0].from, 0);
  EXPECT_EQ(spans[0].to, 1);
}

TEST(TouchingSpans, ofBodiesThatPassThroughEachOtherAreNone) {
  World world;
  world.bodies = {box("a", Vec3::Constant(0.1), 1, Vec3(-1, 0, 0), Vec3(2, 0, 0)),
                  box("b", Vec3::Constant(0.1), 1, Vec3(0, 0, 0))};
  const Trajectory striking = runOf(world, 1);
  ASSERT_EQ(spansIn(striking, 1, Partner::ofBody(0)).size(), 1U);
  EXPECT_EQ(spansIn(striking, 1, Partner::ofBody(0))[0].from, striking.impacts.front().time);
  EXPECT_EQ(spansIn(striking, 0, Partner::ofBody(1))[0].from, striking.impacts.front().time);
  world.apart = {{0, 1}};
  EXPECT_TRUE(spansIn(runOf(world, 1), 0, Partner::ofBody(1)).empty());
}

// By hand: an impact of a run whose boxes are nowhere near each other is a touch of no length.
TEST(TouchingSpans, holdEveryImpact) {
  Trajectory run = driftAndReturn();
  const std::vector<TrueSpan> wall = spansIn(run, 0, Partner::ofWall(1));
  ASSERT_EQ(wall.size(), 1U);
  EXPECT_EQ(wall[0].from, 0.5);
  run.impacts[0].b = Partner::ofWall(0);
  const std::vector<TrueSpan> other = spansIn(run, 0, Partner::ofWall(0));
  ASSERT_EQ(other.size(), 1U);
  EXPECT_EQ(other[0].from, 0.5);
  EXPECT_EQ(other[0].to, 0.5);
  EXPECT_TRUE(touchingSpans(run, 0, Partner::ofWall(0), 0.4).empty());
}

TEST(TouchingGaps, areThoseThatTheRunPromises) {
  Trajectory run = driftAndReturn();
  run.settings.tolerance = 1e-4;
  run.settings.crowds.tolerance = 1e-2;
  EXPECT_DOUBLE_EQ(touchingGaps(run).usual, 4e-4 + 1e-9);
  EXPECT_DOUBLE_EQ(touchingGaps(run).crowd, 3e-2 + 1e-9);
  run.given = GivenPoses();
  EXPECT_DOUBLE_EQ(touchingGaps(run).usual, 0.01 * std::sqrt(0.14));
}

// By hand: it sinks from 1 mm above the floor by half a millimetre in a second; crowds promise 0.9 mm.
TEST(TouchingSpans, ofACrowdBeginAtItsOwnGap) {
  Trajectory run;
  run.settings.duration = 1;
  run.world.walls = {wall("floor", Vec3::UnitZ(), 0)};
  run.world.bodies = {box("a", Vec3::Constant(0.1), 1, Vec3::Zero())};
  CrowdStep step{.duration = 1};
  step.position = {Vec3(0, 0, 0.101), Vec3(0, 0, -5e-4), Vec3::Zero(), Vec3::Zero()};
  step.worldFromBody = {Vec4(0, 0, 0, 1), Vec4::Zero(), Vec4::Zero(), Vec4::Zero()};
  run.tracks = {{.segments = {{.start = 0, .motion = step}}}};
  const std::vector<TrueSpan> spans = spansIn(run, 0, kFloor);
  ASSERT_EQ(spans.size(), 1U);
  EXPECT_NEAR(spans[0].from, (1e-4 - 1e-9) / 5e-4, 1e-12);
}

// A crowd's members touch while they are as near as it promises.
TEST(TouchingSpans, ofCrowdsAreAsWideAsTheyPromise) {
  World world;
  world.gravity = Vec3(0, 0, -kG);
  world.walls = {wall("floor", Vec3::UnitZ(), 0, 0)};
  world.walls[0].material.friction = 0.5;
  for (int i = 0; i < 3; ++i) {
    Body each = box("b" + std::to_string(i), Vec3::Constant(0.1), 1, Vec3(0.01 * i, 0, 0.1 + 0.25 * i),
                    Vec3::Zero(), Vec3::Zero(), 0);
    each.material.friction = 0.5;
    world.bodies.push_back(each);
  }
  const Trajectory run = runOf(world, 2, {.when = CrowdSettings::When::kAbove, .above = 1});
  ASSERT_TRUE(run.figures.boundedFrom.has_value());
  for (int i = 0; i < 2; ++i) {
    const std::vector<TrueSpan> spans = spansIn(run, static_cast<std::size_t>(i + 1), Partner::ofBody(i));
    ASSERT_FALSE(spans.empty());
    EXPECT_EQ(spans.back().to, 2);
    EXPECT_NEAR(spans.front().from, std::sqrt(2 * 0.05 * (i + 1) / kG), 0.01);
  }
}

}  // namespace
}  // namespace careen
