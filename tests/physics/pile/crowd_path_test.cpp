#include "physics/pile/crowd_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/crates.h"
#include "support/crowd_stages.h"

namespace careen {
namespace {

using namespace test;

constexpr double kPathStep = 0.01;

World twoCrates() {
  World world;
  world.gravity = Vec3(0, 0, -10);
  for (int k = 0; k < 2; ++k) {
    world.bodies.push_back(crate("crate" + std::to_string(k), Vec3::Constant(0.25), Vec3(k, 0, 0), {}));
  }
  return world;
}

// Both moved by half a metre per second more than they came with, the second one pushed.
struct Moved {
  Moved() : stages(world) {
    stages.members.h = kPathStep;
    stages.members.begin();
    for (int k = 0; k < 2; ++k) {
      CrowdMembers::Way& way = stages.members.ways[at(k)];
      way = {.position = stages.members[k].position,
             .velocity = Vec3(1, 0, 0),
             .endVelocity = Vec3(2, 0, 0),
             .pushed = k == 1,
             .moved = true};
      stages.members[k].position += kPathStep * Vec3(1.5, 0, 0);
    }
  }
  World world = twoCrates();
  CrowdStages stages;
};

TEST(CrowdPath, whatIsPushedMovesStraightTheOtherAsItsVelocitiesAre) {
  const Moved moved;
  const CrowdPath& path = moved.stages.path;
  EXPECT_EQ(path.begin(0).velocity, Vec3(1, 0, 0));
  EXPECT_EQ(path.end(0).velocity, Vec3(2, 0, 0));
  EXPECT_LT((path.begin(1).velocity - Vec3(1.5, 0, 0)).norm(), 1e-12);
  EXPECT_LT((path.end(1).velocity - Vec3(1.5, 0, 0)).norm(), 1e-12);
  EXPECT_EQ(path.beginAsItCame(1).velocity, Vec3(1, 0, 0));
  EXPECT_EQ(path.begin(1).position, Vec3(1, 0, 0));
}

// A turn by 0.1 rad in the step.
TEST(CrowdPath, spinOfWhatIsPushedIsThatOfItsTurn) {
  Moved moved;
  turnBy(moved.stages.members[1], Vec3(0, 0, 0.1));
  EXPECT_LT((moved.stages.path.end(1).spinBody - Vec3(0, 0, 0.1 / kPathStep)).norm(), 1e-6);
}

// Lasting forces give 0.1 m/s in the step; more than four times that is sudden, for what is pushed.
TEST(CrowdPath, changeIsSuddenBeyondWhatLastingForcesDo) {
  Moved moved;
  EXPECT_EQ(moved.stages.path.changedSuddenly(), (std::vector<char>{0, 1}));
  moved.stages.members[1].position.x() -= 0.15 * kPathStep;  // 0.35 m/s are left
  EXPECT_EQ(moved.stages.path.changedSuddenly(), (std::vector<char>{0, 0}));
}

TEST(CrowdPath, extentIsThatOfSpheresAndWays) {
  Moved moved;
  const double radius = 0.25 * std::sqrt(3.0);
  const CrowdExtent swept = moved.stages.path.swept();
  const double margin = CrowdMembers::kUsualTolerance;
  EXPECT_NEAR(swept.low.x(), -radius - margin, 1e-12);
  EXPECT_NEAR(swept.high.x(), 1.015 + radius + margin, 1e-12);
  moved.stages.members[1].velocity = Vec3(0, 3, 0);
  // In 0.1 s by 3 m/s, and what gravity gives.
  EXPECT_NEAR(moved.stages.path.extent(0.1).high.x(), 1.015 + radius + 0.1 * (3 + 0.1 * 10), 1e-12);
}

TEST(CrowdPath, cameNearByGapAndWay) {
  Moved moved;
  moved.stages.members[1].path = 0.015;
  Body box;
  box.halfExtents = Vec3::Constant(0.25);
  const Pose pose{.position = Vec3(1, 1, 0)};
  // The gap is 0.5, the way and the tolerance 0.0153.
  EXPECT_FALSE(moved.stages.path.cameNear(1, box, pose, 0.48));
  EXPECT_TRUE(moved.stages.path.cameNear(1, box, pose, 0.49));
  moved.stages.members.ways[1].moved = false;
  EXPECT_FALSE(moved.stages.path.cameNear(1, box, pose, 0.49));
}

}  // namespace
}  // namespace careen
