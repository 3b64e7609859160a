#include "physics/joint_freedom.h"

#include <gtest/gtest.h>

#include <array>
#include <utility>

#include "support/jointed.h"

namespace careen {
namespace {

using Kind = Joint::Kind;

World twoBoxes() {
  World world;
  world.bodies = {box("a", Vec3(0.5, 0.1, 0.1), 1, Vec3(0.5, 0, 0)),
                  box("b", Vec3(0.5, 0.1, 0.1), 1, Vec3(1.5, 0, 0)),
                  box("alone", Vec3(0.5, 0.1, 0.1), 1, Vec3(9, 0, 0))};
  return world;
}

void expectFreedom(const World& world, int bodies, int degrees, int rows, int redundant) {
  const JointFreedom freedom = jointFreedom(world);
  EXPECT_EQ(freedom.bodies, bodies);
  EXPECT_EQ(freedom.degrees, degrees);
  EXPECT_EQ(freedom.rows, rows);
  EXPECT_EQ(freedom.redundant, redundant);
}

TEST(JointFreedom, isWhatEachKindLeaves) {
  expectFreedom(twoBoxes(), 0, 0, 0, 0);
  const std::array<std::pair<Kind, int>, 4> kinds{std::pair(Kind::kBall, 3), std::pair(Kind::kHinge, 1),
                                                  std::pair(Kind::kSlider, 1), std::pair(Kind::kFixed, 0)};
  for (const auto& [kind, left] : kinds) {
    World world = twoBoxes();
    test::join(world, kind, 0, 1, Vec3(1, 0, 0)).grip = 1;  // which leaves all
    expectFreedom(world, 2, 6 + left, 6 - left, 0);
    test::join(world, Kind::kBall, 0, {}, Vec3::Zero());
    expectFreedom(world, 2, 3 + left, 9 - left, 0);
  }
  World world = twoBoxes();
  test::tie(world, Kind::kRod, 0, Vec3::Zero(), Vec3(0.5, 0, 3), 3);
  test::tie(world, Kind::kRope, 1, Vec3::Zero(), Vec3(1.5, 0, 3), 3);
  expectFreedom(world, 2, 11, 1, 0);
}

// Four hinges about y make 20 rows of 18 columns; a parallelogram swings nonetheless.
TEST(JointFreedom, ofALoopCountsWhatIsRedundant) {
  World world;
  world.bodies = {box("left", Vec3(0.05, 0.05, 0.5), 1, Vec3(-0.3, 0, 0.5)),
                  box("right", Vec3(0.05, 0.05, 0.5), 1, Vec3(0.3, 0, 0.5)),
                  box("bridge", Vec3(0.3, 0.05, 0.05), 2, Vec3(0, 0, 1))};
  for (const double x : {-0.3, 0.3}) {
    const int side = x < 0 ? 0 : 1;
    test::join(world, Kind::kHinge, side, {}, Vec3(x, 0, 0), Vec3::UnitY());
    test::join(world, Kind::kHinge, side, 2, Vec3(x, 0, 1), Vec3::UnitY());
  }
  expectFreedom(world, 3, 1, 20, 3);
}

// What is fixed has no freedom to lose.
TEST(JointFreedom, leavesOutWhatCannotMove) {
  World world = twoBoxes();
  world.bodies[1].mass = immovable();
  test::join(world, Kind::kHinge, 0, 1, Vec3(1, 0, 0));
  test::join(world, Kind::kFixed, 0, 1, Vec3(1, 0, 0));
  expectFreedom(world, 1, 0, 11, 5);
}

}  // namespace
}  // namespace careen
