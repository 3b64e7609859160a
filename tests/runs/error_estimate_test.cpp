#include "runs/error_estimate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "physics/world/method.h"
#include "runs/difference.h"
#include "support/exact_runs.h"
#include "support/quad_room.h"

namespace careen {
namespace {

World tumble() {
  World world;
  world.bodies = {box("book", Vec3(0.1, 0.2, 0.3), 1, Vec3::Zero(), Vec3(1, 0, 0), Vec3(1, 2, 3))};
  return world;
}

// The largest angle to the closed form at the times of the estimate.
double trueAngle(const World& world, const Trajectory& run) {
  const double duration = run.settings.duration;
  const Trajectory truth = record(world, {.method = Method::kExact, .duration = duration}, "");
  double worst = 0;
  for (int k = 1; k <= kEstimateSamples; ++k) {
    const double time = duration * k / kEstimateSamples;
    worst = std::max(
        worst, angleBetween(run.state(0, time).pose.worldFromBody, truth.state(0, time).pose.worldFromBody));
  }
  return worst;
}

TEST(ErrorEstimate, ofAMethodThatStepsIsItsTrueError) {
  for (const MethodTraits& method : kMethods) {
    if (!method.steps()) {
      continue;
    }
    const double dt = method.order == 1   ? 1e-5
                      : method.order == 2 ? 1.0 / 960
                      : method.order < 10 ? 1.0 / 30
                                          : 1.0 / 15;
    const World world = tumble();
    const Trajectory run = record(world, {.method = method.method, .duration = 2, .dt = dt}, "");
    const std::optional<ErrorEstimate> estimate = estimateError(run);
    ASSERT_TRUE(estimate.has_value());
    EXPECT_EQ(estimate->by, "half the time step");
    EXPECT_EQ(estimate->until, 2);
    EXPECT_FALSE(estimate->horizon.has_value());
    // measured 0.9995 to 1.02
    EXPECT_NEAR(estimate->angle / trueAngle(world, run), 1, 0.05) << method.name;
    EXPECT_LT(estimate->position, 1e-12) << method.name;
  }
}

TEST(ErrorEstimate, ofExactIsItsErrorAgainstAQuadrupleRun) {
  World world = elasticRoom();
  world.bodies[0].initial.pose.worldFromBody.setIdentity();
  oracle::QuadRoom room(world);
  for (int impact = 0; impact < 8; ++impact) {
    room.strike();
  }
  const double end = static_cast<double>(room.time()) + 0.01;
  const Trajectory run = record(world, {.method = Method::kExact, .duration = end}, "");
  const std::optional<ErrorEstimate> estimate = estimateError(run);
  ASSERT_TRUE(estimate.has_value());
  EXPECT_EQ(estimate->by, "a start one rounding error away and a tenth of the tolerance");
  EXPECT_FALSE(estimate->holds.has_value());
  double error = 0;
  const auto corners = room.corners(Quad(end) - room.time());
  const Pose pose = run.state(0, end).pose;
  for (int k = 0; k < kCorners; ++k) {
    const Vec3 at = pose.position + pose.worldFromBody * corner(world.bodies[0].halfExtents, k);
    error = std::max(error, (at - corners.at(static_cast<std::size_t>(k)).cast<double>()).norm());
  }
  // One run's rounding error against another's: only the order of magnitude can be known. Measured 8.
  const double estimated = estimate->position + estimate->angle * world.bodies[0].halfExtents.norm();
  EXPECT_GT(estimated, error / 30);
  EXPECT_LT(estimated, error * 30);
  RecordProperty("estimated over true", std::to_string(estimated / error));
}

// A box that rocks, slides and comes to rest, against a run with a tolerance of 1e-10 m. Estimates in contact
// hold in 19 of 20 scenes, and are not of another order.
TEST(ErrorEstimate, inContactIsThreeTimesTheErrorAtMost) {
  World world;
  world.gravity = Vec3(0, 0, -9.81);
  world.walls = {wall("floor", Vec3(0, 0, 1), 0, 0)};
  world.walls[0].material.friction = 0.4;
  world.bodies = {
      box("crate", Vec3(0.1, 0.2, 0.3), 1, Vec3(0, 0, 0.35), Vec3(0.6, 0.2, 0), Vec3(0.3, 0.9, 0.2), 0)};
  world.bodies[0].material.friction = 0.4;
  RunSettings settings{.method = Method::kExact, .duration = 1.5};
  const Trajectory run = record(world, settings, "");
  settings.tolerance = 1e-10;
  const Trajectory truth = record(world, settings, "");
  const std::optional<ErrorEstimate> estimate = estimateError(run);
  ASSERT_TRUE(estimate.has_value());
  EXPECT_EQ(estimate->by, "a start one rounding error away and a tenth of the tolerance, and a hundredth");
  EXPECT_EQ(estimate->holds, 0.95);
  EXPECT_EQ(estimate->until, 1.5);
  EXPECT_EQ(estimateCost(run), 3);
  double error = 0;
  for (int k = 1; k <= kEstimateSamples; ++k) {
    const double time = settings.duration * k / kEstimateSamples;
    error = std::max(error, (run.state(0, time).pose.position - truth.state(0, time).pose.position).norm());
  }
  EXPECT_GT(error, 1e-9);  // there is something to estimate
  EXPECT_GT(estimate->position, error);
  EXPECT_LT(estimate->position, 3.5 * error);  // measured 2.96
}

// A row of six dominoes, the first one leaning over its edge by an angle with sine 0.2.
World dominoes() {
  World world;
  world.gravity = Vec3(0, 0, -9.81);
  world.walls = {wall("floor", Vec3(0, 0, 1), 0, 0)};
  const Vec3 half(0.05, 0.2, 0.4);
  for (int k = 0; k < 6; ++k) {
    world.bodies.push_back(box("domino-" + std::to_string(k), half, 40, Vec3(0.42 * k, 0, half.z()),
                               Vec3::Zero(), Vec3::Zero(), 0));
    world.bodies.back().material.friction = 0.4;
  }
  world.walls[0].material.friction = 0.4;
  const double sine = 0.2;
  const double cosine = std::sqrt(1 - sine * sine);
  Pose& first = world.bodies[0].initial.pose;
  first.worldFromBody << cosine, 0, sine, 0, 1, 0, -sine, 0, cosine;
  const Vec3 pivot(half.x(), 0, -half.z());
  first.position = Vec3(half.x(), 0, 0) - first.worldFromBody * pivot;
  return world;
}

TEST(ErrorEstimate, ofCrowdsCoversTheDifferenceFromExactContact) {
  const World world = dominoes();
  RunSettings settings{.method = Method::kExact, .duration = 1.2};
  settings.crowds.when = CrowdSettings::When::kNever;
  settings.tolerance = 1e-8;
  const Trajectory truth = record(world, settings, "");
  settings.crowds = {.when = CrowdSettings::When::kAbove, .above = 1, .tolerance = 3e-4};
  settings.tolerance = 1e-6;
  const Trajectory run = record(world, settings, "");
  ASSERT_TRUE(run.figures.boundedFrom.has_value());
  const std::optional<ErrorEstimate> estimate = estimateError(run);
  ASSERT_TRUE(estimate.has_value());
  double error = 0;
  for (int k = 1; k <= kEstimateSamples; ++k) {
    const double time = settings.duration * k / kEstimateSamples;
    for (std::size_t body = 0; body < world.bodies.size() && time <= estimate->until; ++body) {
      error = std::max(error,
                       (run.state(body, time).pose.position - truth.state(body, time).pose.position).norm());
    }
  }
  EXPECT_GT(estimate->until, 0.5);
  EXPECT_GT(error, 1e-5);  // there is something to estimate
  EXPECT_GT(estimate->position, error);
  EXPECT_LT(estimate->position, 30 * error);
  RecordProperty("estimated over true", std::to_string(estimate->position / error));
}

TEST(ErrorEstimate, findsWhereChaosTakesOver) {
  const World world = elasticRoom();
  const Trajectory run = record(world, {.method = Method::kExact, .duration = 30}, "");
  const std::optional<ErrorEstimate> estimate = estimateError(run);
  ASSERT_TRUE(estimate.has_value());
  ASSERT_TRUE(estimate->horizon.has_value());
  // This run and the quadruple run diverge after some 17 impacts.
  EXPECT_GT(*estimate->horizon, 3);
  EXPECT_LT(*estimate->horizon, 12);
  EXPECT_LT(estimate->until, *estimate->horizon);
  EXPECT_LE(estimate->position / world.bodies[0].halfExtents.norm(), kHorizonDifference);
}

TEST(ErrorEstimate, saysNothingWhereTheRunCannotBeRepeated) {
  // Euler falls less with longer time steps: with half of them the cube lands in time, and cannot rest.
  World world;
  world.gravity = Vec3(0, 0, -10);
  world.walls = {wall("floor", Vec3(0, 0, 1), 0, 0)};
  world.bodies = {box("cube", Vec3(0.5, 0.5, 0.5), 1, Vec3(0, 0, 1), Vec3::Zero(), Vec3::Zero(), 0)};
  const Trajectory run = record(world, {.method = Method::kListing1, .duration = 0.33, .dt = 1.0 / 30}, "");
  EXPECT_FALSE(estimateError(run).has_value());
}

TEST(ErrorEstimate, aStartOneRoundingAwayMovesNothingElse) {
  World world = elasticRoom();
  world.bodies.push_back(world.bodies[0]);
  world.bodies[1].mass = immovable();
  const World away = oneRoundingAway(world);
  EXPECT_EQ(away.bodies[0].initial.pose.position.z(), 3 * (1 + 0x1p-52));
  EXPECT_EQ(away.bodies[0].initial.pose.position.x(), 0);
  EXPECT_EQ(away.bodies[0].initial.velocity.x(), 3 * (1 + 0x1p-52));
  EXPECT_EQ(away.bodies[1].initial.pose.position, world.bodies[1].initial.pose.position);
  EXPECT_EQ(away.walls[0].offset, world.walls[0].offset);
}

}  // namespace
}  // namespace careen
