#include "physics/contact/island.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace careen {
namespace {

constexpr double kGravity = 9.81;
constexpr double kFriction = 0.5;

// A box that lies on the floor, and what becomes of it until it rests or `duration` is over.
struct Lying {
  explicit Lying(Vec3 halfExtents) : half(std::move(halfExtents)) {
    world.gravity = Vec3(0, 0, -kGravity);
    world.walls = {{.name = "floor", .material = {0, kFriction}}};
    world.bodies = {{.name = "box",
                     .halfExtents = half,
                     .mass = solidBox(half, 2),
                     .material = {0, kFriction},
                     .initial = {}}};
  }

  TouchingBody run(const Vec3& velocity, double spin, double tolerance) {
    std::vector<ContactFeature> features;
    for (int k = 0; k < kCorners; ++k) {
      if (corner(half, k).z() < 0) {
        features.push_back({.a = 0, .b = 1, .onA = corner(half, k), .material = {0, kFriction}});
      }
    }
    const TouchingBody box{.body = world.bodies.data(),
                           .index = 0,
                           .position = Vec3(0, 0, half.z()),
                           .worldFromBody = Quat::Identity(),
                           .velocity = velocity,
                           .angularVelocityBody = Vec3(0, 0, spin)};
    Island island(world, {box, touchingBody(world.walls[0])}, features, tolerance,
                  timeScaleOf(world, tolerance));
    for (island.begin(); !island.rests(); island.begin()) {
      Island::Step step;
      do {
        step = island.step(1);
        time += step.length;
        EXPECT_LT(++steps, 10'000);
      } while (step.end == Island::End::kGoesOn && steps < 10'000);
    }
    return island.bodies()[0];
  }

  Vec3 half;
  World world;
  double time = 0;
  int steps = 0;
};

TEST(Island, slidesToItsStopInTheDirectionItStarted) {
  double worst = 0;
  for (int azimuth = 0; azimuth < 16; ++azimuth) {
    Lying lying(Vec3(0.5, 0.3, 0.2));
    const double angle = 2 * M_PI * azimuth / 16;
    const Vec3 along(std::cos(angle), std::sin(angle), 0);
    const TouchingBody end = lying.run(3 * along, 0, 1e-6);
    worst =
        std::max(worst, (end.position - (9 / (2 * kFriction * kGravity)) * along - Vec3(0, 0, 0.2)).norm());
    EXPECT_NEAR(lying.time, 3 / (kFriction * kGravity), 1e-5);
  }
  RecordProperty("worst", std::to_string(worst * 1e12) + "e-12");
  EXPECT_LT(worst, 1e-9);
}

// τ = μ m g √(a²+b²), the model of four corners.
TEST(Island, spinsToItsStopOnFourCorners) {
  for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
    Lying lying(Vec3(0.5, 0.3, 0.2));
    const TouchingBody end = lying.run(Vec3::Zero(), 5, tolerance);
    const double inertia = 2.0 / 3 * (0.25 + 0.09);
    const double slowing = kFriction * 2 * kGravity * std::sqrt(0.34) / inertia;
    const double angle = 2 * std::atan2(end.worldFromBody.z(), end.worldFromBody.w());
    EXPECT_NEAR(angle, 25 / (2 * slowing), tolerance) << tolerance;
    EXPECT_LT((end.position - Vec3(0, 0, 0.2)).norm(), 1e-15);
  }
}

// Sliding and spinning at once has no closed form: the error goes with the tolerance.
TEST(Island, slidesAndSpinsWithinItsTolerance) {
  Lying exact(Vec3(0.5, 0.3, 0.2));
  const TouchingBody truth = exact.run(Vec3(3, 1, 0), 5, 1e-12);
  double last = 1;
  for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
    Lying lying(Vec3(0.5, 0.3, 0.2));
    const TouchingBody end = lying.run(Vec3(3, 1, 0), 5, tolerance);
    const double error = (end.position - truth.position).norm();
    EXPECT_LT(error, tolerance);
    EXPECT_LT(error, last / 8);
    last = error;
  }
}

TEST(Island, restsAtOnceOnALevelFloor) {
  Lying lying(Vec3(0.5, 0.3, 0.2));
  lying.run(Vec3::Zero(), 0, 1e-6);
  EXPECT_EQ(lying.steps, 0);
}

// Cubes off each other's middle, the top one heavier by a factor: what is carried at each height is the
// weight above it, and about no axis does it turn.
TEST(Island, forcesOfAStackAreSumsOfWeights) {
  constexpr int kCubes = 10;
  const Vec3 half(0.5, 0.5, 0.5);
  // the last one measured 8.3e-13
  for (const auto& [top, bound] : {std::pair(1.0, 1e-15), {1e2, 1e-15}, {1e4, 1e-14}, {1e6, 1e-11}}) {
    World world;
    world.gravity = Vec3(0, 0, -kGravity);
    world.walls = {{.name = "floor", .material = {0, kFriction}}};
    for (int k = 0; k < kCubes; ++k) {
      world.bodies.push_back({.name = "cube",
                              .halfExtents = half,
                              .mass = solidBox(half, k == kCubes - 1 ? top : 1),
                              .material = {},
                              .initial = {}});
    }
    std::vector<TouchingBody> bodies;
    std::vector<ContactFeature> features;
    for (int k = 0; k < kCubes; ++k) {
      bodies.push_back({.body = &world.bodies[static_cast<std::size_t>(k)],
                        .index = k,
                        .position = Vec3(0.01 * (k % 3), 0.01 * (k % 2), 0.5 + k),
                        .worldFromBody = Quat::Identity(),
                        .velocity = Vec3::Zero(),
                        .angularVelocityBody = Vec3::Zero()});
      for (int c = 0; c < 4; ++c) {
        const Vec3 at(c % 2 == 0 ? -0.4 : 0.4, c / 2 == 0 ? -0.4 : 0.4, -0.5);
        ContactFeature feature{.a = k, .b = kCubes, .onA = at, .material = {0, kFriction}};
        if (k > 0) {
          feature.kind = ContactFeature::Kind::kPointOnFace;
          feature.b = k - 1;
          feature.axisB = 2;
        }
        features.push_back(feature);
      }
    }
    bodies.push_back(touchingBody(world.walls[0]));
    Island island(world, bodies, features, 1e-6, timeScaleOf(world, 1e-6));
    island.begin();
    double worst = 0;
    for (int k = 0; k < kCubes; ++k) {
      const double above = kGravity * (kCubes - 1 - k + top);
      double carried = 0;
      for (std::size_t c = 0; c < 4; ++c) {
        carried += island.system().forces().forces()[4 * static_cast<std::size_t>(k) + c][0];
      }
      worst = std::max(worst, std::fabs(carried - above) / above);
    }
    EXPECT_LT(worst, bound) << top;
  }
}

}  // namespace
}  // namespace careen
