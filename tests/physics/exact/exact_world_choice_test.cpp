#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "physics/exact/exact_world.h"
#include "support/exact_runs.h"
#include "support/tumbling_box.h"

// Contacts with many normals: joints of slabs, grids and blocks of boxes. What touches and what is 1e-12 m
// apart moves alike.

namespace careen {
namespace {

using test::Dice;
using test::turned;

Body made(const std::string& name, const Vec3& half, const Vec3& place, const Material& material,
          const Vec3& velocity = Vec3::Zero()) {
  Body body = box(name, half, 1, place, velocity);
  body.material = material;
  return body;
}

Body fixed(Body body) {
  body.mass = immovable();
  return body;
}

// A box on the joints of slabs of one height: rough, it slows by μg; nothing else happens to it.
TEST(ExactWorldChoice, jointsOfSlabsAreNotFelt) {
  constexpr double kGravity = 9.81;
  Dice dice(7);
  for (int k = 0; k < 120; ++k) {
    const double gap = k % 5 == 0 ? 0 : std::pow(10, -dice.between(3, 12));
    const Material material{.restitution = k % 3 == 0 ? 0.7 : 0, .friction = k % 2 == 0 ? 0 : 0.3};
    const double yaw = k % 4 == 0 ? 0 : std::pow(10, -dice.between(1, 9));
    World world;
    world.gravity = Vec3(0, 0, -kGravity);
    const Vec3 slab(0.3, 0.5, 0.05);
    constexpr int kSlabs = 4;
    for (int i = 0; i < kSlabs; ++i) {
      const Vec3 place(slab.x() + i * (2 * slab.x() + gap), 0, -slab.z());
      world.bodies.push_back(fixed(made("slab" + std::to_string(i), slab, place, material)));
    }
    const Vec3 half(0.1, 0.09, 0.08);
    Body cube = made("cube", half, Vec3(0.2, 0, half.z()), material, Vec3(4, 0, 0));
    cube.initial.pose.worldFromBody = turned<double>(Vec3::UnitZ(), yaw);
    world.bodies.push_back(cube);
    const double way = kSlabs * 2 * slab.x() - 0.4;
    const double last = std::sqrt(16 - 2 * material.friction * kGravity * way);
    const double duration = material.friction > 0 ? (4 - last) / (material.friction * kGravity) : way / 4;
    const BodyState end = runFor(world, duration).last(world, kSlabs, duration);
    ASSERT_NEAR(end.velocity.x(), last, 1e-5) << k << ", gap " << gap << ", yaw " << yaw;  // measured 7.3e-6
    ASSERT_NEAR(end.pose.position.z(), half.z(), 1e-6) << k << ", gap " << gap << ", yaw " << yaw;
  }
}

// One slab is higher by far more than the tolerance: the box strikes it.
TEST(ExactWorldChoice, aRealStepIsStruck) {
  World world;
  world.gravity = Vec3(0, 0, -9.81);
  const Material smooth{.restitution = 0, .friction = 0};
  world.bodies.push_back(fixed(made("low", Vec3(0.5, 0.5, 0.05), Vec3(0, 0, -0.05), smooth)));
  world.bodies.push_back(fixed(made("high", Vec3(0.5, 0.5, 0.05), Vec3(1, 0, -0.04), smooth)));
  world.bodies.push_back(made("cube", Vec3(0.1, 0.1, 0.1), Vec3(0, 0, 0.1), smooth, Vec3(1, 0, 0)));
  const BodyState end = runFor(world, 0.45).last(world, 2, 0.45);
  EXPECT_LT(end.velocity.x(), 0.8);
}

/// A block of elastic cubes without friction, and one that strikes the middle of its side.
World struckBlock(int x, int y, int z, double gap) {
  World world;
  const Material elastic{.restitution = 1, .friction = 0};
  const Vec3 half(0.1, 0.1, 0.1);
  const double pitch = 0.2 + gap;
  for (int i = 0; i < x * y * z; ++i) {
    const Vec3 place(0.2 * (i % x), pitch * (i / x % y), pitch * (i / (x * y)));
    world.bodies.push_back(made("cube" + std::to_string(i), half, place, elastic));
  }
  world.bodies.push_back(
      made("striker", half, Vec3(-0.25, pitch * (y / 2), pitch * (z / 2)), elastic, Vec3(3, 0, 0)));
  return world;
}

TEST(ExactWorldChoice, aStruckBlockOfCubesMovesOneRowOnly) {
  for (const auto& [x, y, z] : std::vector<std::array<int, 3>>{{3, 3, 1}, {3, 3, 3}, {4, 3, 5}, {5, 5, 5}}) {
    for (const double gap : {0.0, 1e-9}) {
      const World world = struckBlock(x, y, z, gap);
      const Recorded run = runFor(world, 0.05);
      const int struck = (z / 2 * y + y / 2) * x + x - 1;
      for (int i = 0; i <= x * y * z; ++i) {
        const Vec3 velocity = run.last(world, static_cast<std::size_t>(i), 0.05).velocity;
        const Vec3 expected = i == struck ? Vec3(3, 0, 0) : Vec3::Zero();
        EXPECT_NEAR((velocity - expected).norm(), 0, 1e-12) << x << y << z << " gap " << gap << ", box " << i;
      }
    }
  }
}

// [1] Of gravity, the lateral load at which columns of boxes side by side begin to fall.
double loadOf(int columns, int rows, double gap) {
  double low = 0.1;
  double high = 0.49;
  while (high - low > 1e-5) {
    const double load = 0.5 * (low + high);
    World world;
    const Material rough{.restitution = 0, .friction = 0.5};
    world.gravity = Vec3(load * 9.81, 0, -9.81);
    world.walls = {wall("floor", Vec3(0, 0, 1), 0, 0)};
    world.walls[0].material = rough;
    const Vec3 half(0.2, 0.15, 0.15);
    for (int i = 0; i < columns * rows; ++i) {
      const Vec3 place((0.4 + gap) * (i / rows), 0, 0.15 + 0.3 * (i % rows));
      world.bodies.push_back(made("box" + std::to_string(i), half, place, rough));
    }
    const Recorded run = runFor(world, 0.02);
    double fastest = 0;
    for (std::size_t i = 0; i < world.bodies.size(); ++i) {
      fastest = std::max(fastest, run.last(world, i, 0.02).velocity.norm());
    }
    (fastest > 2e-5 ? high : low) = load;
  }
  return low;
}

// By moments a column of r boxes falls at .4/(.3 r): at its side it has nothing to lean on.
TEST(ExactWorldChoice, columnsFallAtTheSameLoadWhetherTheyTouchOrNot) {
  for (const auto& [columns, rows] : std::vector<std::array<int, 2>>{{2, 3}, {2, 4}, {3, 4}}) {
    const double alone = 0.4 / (0.3 * rows);
    EXPECT_NEAR(loadOf(columns, rows, 0), alone, 2e-4) << columns << rows;      // measured 9.1e-5
    EXPECT_NEAR(loadOf(columns, rows, 1e-12), alone, 4e-4) << columns << rows;  // measured 2.4e-4
  }
}

// Cubes in a row on a floor: one impact, however many they are.
TEST(ExactWorldChoice, aCradleOfManyIsNoCrowd) {
  World world;
  world.gravity = Vec3(0, 0, -9.81);
  world.walls = {wall("floor", Vec3(0, 0, 1), 0, 0)};
  const Material elastic{.restitution = 1, .friction = 0};
  const Vec3 half(0.1, 0.1, 0.1);
  constexpr int kCubes = 150;
  for (int i = 0; i < kCubes; ++i) {
    world.bodies.push_back(made("cube" + std::to_string(1000 + i), half, Vec3(0.2 * i, 0, 0.1), elastic));
  }
  world.bodies.push_back(made("striker", half, Vec3(-0.5, 0, 0.1), elastic, Vec3(2, 0, 0)));
  const Recorded run = runFor(world, 0.5);
  EXPECT_NEAR(run.last(world, kCubes, 0.5).velocity.norm(), 0, 1e-11);
  EXPECT_NEAR(run.last(world, kCubes - 1, 0.5).velocity.x(), 2, 1e-11);
}

}  // namespace
}  // namespace careen
