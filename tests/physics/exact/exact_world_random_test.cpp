#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "physics/exact/exact_world.h"
#include "physics/geometry/separation.h"
#include "support/exact_runs.h"
#include "support/impact_scene.h"

// Scenes at random: no energy gained, nothing sinks or gets out, and the run
// comes to its end. CAREEN_RANDOM_SCENES="1000 200" takes 200 scenes from
// number 1000 on. Without it: a few, and those that have found something out.

namespace careen {
namespace {

using test::Random;

double spread(Random& random, double low, double high) {
  return std::exp(random.between(std::log(low), std::log(high)));
}

void addRoom(World& world, const Vec3& low, const Vec3& high, const Material& material) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {1.0, -1.0}) {
      const Vec3 normal = side * Vec3::Unit(axis);
      const std::string name = {side > 0 ? '-' : '+', static_cast<char>('x' + axis)};
      world.walls.push_back(wall(name, normal, side > 0 ? low[axis] : -high[axis]));
      world.walls.back().material = material;
    }
  }
}

struct RandomScene {
  World world;
  double duration = 0;
  double tolerance = 0;
};

/// One to eight crates of a size that fall on each other.
RandomScene everyday(std::uint64_t seed) {
  Random random(seed);
  RandomScene scene{.world = {}, .duration = 5, .tolerance = 1e-6};
  scene.world.gravity = Vec3(0, 0, -9.81);
  const std::array<double, 4> roughness{0, 0.3, 0.5, 0.8};
  const std::array<double, 4> bounces{0, 0, 0.3, 0.6};
  double height = 0.1;
  for (int k = 1 + random.below(8); k > 0; --k) {
    const Vec3 half(random.between(0.1, 0.5), random.between(0.1, 0.5), random.between(0.1, 0.5));
    height += half.norm();
    Body body = box("box-" + std::to_string(k), half, spread(random, 0.1, 10),
                    Vec3(random.between(-0.5, 0.5), random.between(-0.5, 0.5), height), random.inCube(2));
    body.initial.pose.worldFromBody = random.rotation();
    body.initial.angularMomentum =
        angularMomentum(body.mass, body.initial.pose.worldFromBody, random.inCube(4));
    body.material = {.restitution = bounces.at(static_cast<std::size_t>(random.below(4))),
                     .friction = roughness.at(static_cast<std::size_t>(random.below(4)))};
    scene.world.bodies.push_back(body);
    height += half.norm();
  }
  addRoom(scene.world, Vec3(-3, -3, 0), Vec3(3, 3, height + 1), {.restitution = 0, .friction = 0.5});
  return scene;
}

/// Sizes from 1 mm to 100 m, masses up to a million apart, up to 1000 m/s.
RandomScene extreme(std::uint64_t seed) {
  Random random(seed);
  const double size = spread(random, 2e-3, 50);
  const double pace = std::min(1000.0, spread(random, 0.1, 100) * std::sqrt(9.81 * size));
  RandomScene scene{.world = {}, .duration = 20 * std::sqrt(size / 9.81), .tolerance = 1e-6 * size};
  scene.world.gravity = Vec3(0, 0, -9.81);
  double height = 0.1 * size;
  for (int k = 1 + random.below(6); k > 0; --k) {
    const Vec3 half = size * Vec3(spread(random, 0.2, 1), spread(random, 0.2, 1), spread(random, 0.2, 1));
    height += half.norm();
    Body body =
        box("box-" + std::to_string(k), half, spread(random, 1e-3, 1e3),
            Vec3(random.between(-size, size), random.between(-size, size), height), random.inCube(pace));
    body.initial.pose.worldFromBody = random.rotation();
    body.initial.angularMomentum =
        angularMomentum(body.mass, body.initial.pose.worldFromBody, random.inCube(pace / size));
    body.material = {.restitution = random.between(0, 0.9), .friction = random.between(0, 1.2)};
    scene.world.bodies.push_back(body);
    height += half.norm();
  }
  const Vec3 corner(4 * size, 4 * size, height + size);
  addRoom(scene.world, Vec3(-corner.x(), -corner.y(), 0), corner,
          {.restitution = random.between(0, 0.5), .friction = 0.5});
  return scene;
}

struct Verdict {
  double deepest = 0;  // [m] that two boxes, or a box and a wall, share at any
                       // of the moments looked at
  bool finite = true;
};

Verdict judge(const RandomScene& scene, const Recorded& run) {
  Verdict verdict;
  const std::vector<Body>& bodies = scene.world.bodies;
  std::vector<std::size_t> motion(bodies.size(), 0);
  constexpr int kMoments = 600;
  for (int moment = 0; moment <= kMoments; ++moment) {
    const double time = scene.duration * moment / kMoments;
    std::vector<Pose> poses;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      const auto& motions = run.motions[k];
      while (motion[k] + 1 < motions.size() && motions[motion[k] + 1].first <= time) {
        ++motion[k];
      }
      const auto& [start, how] = motions[motion[k]];
      poses.push_back(stateAt(how, bodies[k].mass, time - start).pose);
      verdict.finite = verdict.finite && poses.back().position.allFinite();
      for (const Wall& each : scene.world.walls) {
        const double gap = gapToPlane({poses[k], bodies[k].halfExtents}, each.normal, each.offset);
        verdict.deepest = std::max(verdict.deepest, -gap);
      }
      for (std::size_t other = 0; other < k; ++other) {
        const double gap =
            BoxAxes({poses[k], bodies[k].halfExtents}, {poses[other], bodies[other].halfExtents}).gap();
        verdict.deepest = std::max(verdict.deepest, -gap);
      }
    }
  }
  return verdict;
}

using Seeds = std::vector<std::uint64_t>;

Seeds seedsOr(Seeds usual) {
  if (const char* const asked = std::getenv("CAREEN_RANDOM_SCENES")) {
    std::uint64_t first = 1;
    std::uint64_t count = 0;
    std::istringstream(asked) >> first >> count;
    usual.resize(count);
    std::iota(usual.begin(), usual.end(), first);
  }
  return usual;
}

struct Worst {
  double energy = 0;
  double deepest = 0;  // [1] of the tolerance
};

void run(RandomScene (*make)(std::uint64_t), const Seeds& seeds, double energyBound, double depthBound) {
  Worst worst;
  for (const std::uint64_t seed : seeds) {
    const RandomScene scene = make(seed);
    Recorded recorded;
    recorded.motions.resize(scene.world.bodies.size());
    Notes notes(recorded);
    try {
      recorded.figures =
          ExactWorld(scene.world, {.duration = scene.duration, .tolerance = scene.tolerance}, notes).run({});
    } catch (const std::exception& error) {
      ADD_FAILURE() << "scene " << seed << ": " << error.what();
      continue;
    }
    const Verdict verdict = judge(scene, recorded);
    EXPECT_TRUE(verdict.finite) << "scene " << seed;
    EXPECT_FALSE(recorded.figures.boundedFrom) << "scene " << seed;
    EXPECT_LE(recorded.figures.energyChange, energyBound) << "scene " << seed;
    EXPECT_LE(verdict.deepest, depthBound * scene.tolerance) << "scene " << seed;
    worst.energy = std::max(worst.energy, recorded.figures.energyChange);
    worst.deepest = std::max(worst.deepest, verdict.deepest / scene.tolerance);
  }
  std::ostringstream text;
  text << seeds.size() << " scenes: energy " << worst.energy << ", depth " << worst.deepest
       << " of the tolerance";
  ::testing::Test::RecordProperty("worst", text.str());
  std::printf("%s\n", text.str().c_str());
}

// Energy gained, of the largest kinetic energy; depth in tolerances. Measured
// 2e-7 and 2.6.
TEST(ExactWorldRandom, everydayScenesGainNoEnergyAndNothingSinks) {
  run(everyday, seedsOr({1, 2, 3, 4, 7, 19, 20, 33, 45, 74, 78, 90, 106, 116, 388, 458, 477, 537}), 1e-6, 3);
}

// Measured 1.9e-7 and 0.24; of the seeds up to 410 two gain more than 1e-7.
TEST(ExactWorldRandom, extremeScenesGainNoEnergyAndNothingSinks) {
  run(extreme, seedsOr({1, 2, 3, 4, 15, 16, 17, 25, 42, 76, 97, 101, 109, 187, 287}), 3e-7, 1);
}

}  // namespace
}  // namespace careen
