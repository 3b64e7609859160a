#include "audit/cone.h"

#include <gtest/gtest.h>

#include <random>

namespace careen {
namespace {

const WallForce kFloor{.normal = Vec3::UnitZ(), .friction = 0};
const WallForce kRoughFloor{.normal = Vec3::UnitZ(), .friction = 0.5};
const WallForce kSide{.normal = Vec3::UnitX(), .friction = 0};

TEST(Cone, wallsPushButDoNotPull) {
  EXPECT_NEAR(beyondWalls(Vec3(0, 0, 5), {kFloor}).norm(), 0, 1e-14);
  EXPECT_NEAR((beyondWalls(Vec3(0, 0, -5), {kFloor}) - Vec3(0, 0, -5)).norm(), 0, 1e-14);
  EXPECT_NEAR((beyondWalls(Vec3(1, 2, 5), {kFloor}) - Vec3(1, 2, 0)).norm(), 0, 1e-14);
  EXPECT_NEAR((beyondWalls(Vec3(-1, 2, 5), {kFloor, kSide}) - Vec3(-1, 2, 0)).norm(), 0, 1e-14);
}

TEST(Cone, frictionReachesToItsCoefficientAndNoFarther) {
  for (int i = 0; i < 100; ++i) {
    const double angle = 0.1 * i;
    const Vec3 along(std::cos(angle), std::sin(angle), 0);
    EXPECT_NEAR(beyondWalls(Vec3(0, 0, 2) + 0.99 * along, {kRoughFloor}).norm(), 0, 1e-12);
    EXPECT_GT(beyondWalls(Vec3(0, 0, 2) + 1.1 * along, {kRoughFloor}).norm(), 0.02);
  }
}

// What is left is the nearest: no edge of any wall makes it shorter.
TEST(Cone, nothingOfTheRestCouldBeGivenByAWall) {
  std::mt19937 engine(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    std::vector<WallForce> walls;
    for (int k = 0; k < 1 + i % 4; ++k) {
      walls.push_back(
          {Vec3(normal(engine), normal(engine), normal(engine)).normalized(), k % 2 == 0 ? 0 : 0.3});
    }
    const Vec3 impulse(normal(engine), normal(engine), normal(engine));
    const Vec3 left = beyondWalls(impulse, walls);
    EXPECT_LE(left.norm(), impulse.norm() * (1 + 1e-12));
    EXPECT_NEAR(left.dot(impulse - left), 0, 1e-10);  // a projection onto a cone
    for (const WallForce& wall : walls) {
      EXPECT_LE(wall.normal.dot(left), 1e-10);
    }
  }
}

}  // namespace
}  // namespace careen
