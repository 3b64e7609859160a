// How deep the members of a crowd go into each other.
#include <gtest/gtest.h>

#include <algorithm>

#include "physics/pile/crowd.h"
#include "physics/pile/crowd_depth.h"
#include "support/crates.h"
#include "support/crowd_run.h"
#include "support/crowd_stages.h"
#include "support/pile_scenes.h"

namespace careen {
namespace {

// [m] At the ends of frames.
double deepestOf(test::CrowdRun& crowd, int frames) {
  double deepest = 0;
  for (int frame = 0; frame < frames; ++frame) {
    crowd.step();
    deepest = std::max(deepest, crowd.deepest());
    for (const BodyState& state : crowd.states()) {
      EXPECT_LT(state.pose.position.norm(), 100) << frame;
    }
  }
  return deepest;
}

TEST(CrowdDepth, overlapStaysSmallAtEveryFrameOfPouring) {
  const World world = test::pouring(60, 0.5, 0, 1, 3);
  test::CrowdRun crowd(world);
  const double deepest = deepestOf(crowd, 360);
  EXPECT_LT(deepest, 1e-3);
  EXPECT_LT(crowd.deepest(), 3e-4);
  EXPECT_GT(deepest, 0);
}

World twoCrates(double apart) {
  World world;
  world.bodies.push_back(test::crate("a", Vec3::Constant(0.25), Vec3(0, 0, 0), {}));
  world.bodies.push_back(test::crate("b", Vec3::Constant(0.25), Vec3(0.5 + apart, 0.1, 0), {}));
  return world;
}

// One goes so far into the other; below 1.5 tolerances it is not said.
TEST(CrowdDepth, isByWhatOneWentIntoTheOther) {
  const double tolerance = CrowdMembers::kUsualTolerance;
  for (const double depth : {1.4 * tolerance, 1.6 * tolerance, 0.01}) {
    const World world = twoCrates(0.001);
    test::CrowdStages stages(world);
    stages.members.begin();
    stages.meet(test::kCrowdStep);
    stages.members[1].position.x() -= 0.001 + depth;
    stages.members[1].path += 0.001 + depth;
    stages.members[1].ahead = 0.001 + depth;
    stages.members[1].velocity = Vec3(-(0.001 + depth) / test::kCrowdStep, 0, 0);
    const bool deep = depth > 1.5 * tolerance;
    EXPECT_NEAR(stages.depth.find(), deep ? depth : 0, 1e-12);
    EXPECT_EQ(stages.depth.anyIsDeep(), deep);
    EXPECT_NEAR(stages.depth.overlap(stages.contacts.pairs()[0]), depth, 1e-12);
    EXPECT_EQ(stages.depth.before(stages.contacts.pairs()[0]), 0);
  }
}

// What was as deep before the step did not go deeper in it: it is undone by others.
TEST(CrowdDepth, ofBeforeIsNotOfTheStep) {
  const double depth = 1.6 * CrowdMembers::kUsualTolerance;
  const World world = twoCrates(-depth);
  test::CrowdStages stages(world);
  stages.members.begin();
  stages.meet(test::kCrowdStep);
  EXPECT_EQ(stages.depth.find(), 0);
  EXPECT_NEAR(stages.depth.undone(), depth, 1e-12);
  EXPECT_NEAR(stages.depth.before(stages.contacts.pairs()[0]), depth, 1e-12);
}

// Small crates that pass through each other, apart at both ends of the step: in its middle they are one in
// the other, by the size of both.
TEST(CrowdDepth, isSeenOnTheWay) {
  World world;
  for (const double x : {-0.2, 0.0}) {
    world.bodies.push_back(test::crate("crate", Vec3::Constant(0.05), Vec3(x, 0, 0), {}));
  }
  test::CrowdStages stages(world);
  stages.members.begin();
  stages.meet(test::kCrowdStep);
  stages.members[0].position.x() = 0.2;
  stages.depth.findTurns();
  EXPECT_NEAR(stages.depth.onWay({.a = 0, .b = 1}), 0.1, 1e-12);
  stages.members[0].position = Vec3(-0.2, 0.4, 0);  // beside it
  stages.depth.findTurns();
  EXPECT_EQ(stages.depth.onWay({.a = 0, .b = 1}), 0);
}

}  // namespace
}  // namespace careen
