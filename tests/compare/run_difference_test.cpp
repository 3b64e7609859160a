#include "compare/run_difference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/exact_runs.h"
#include "support/input_error.h"
#include "support/trajectories.h"

namespace careen {
namespace {

Trajectory bouncing(double startOff = 0, double duration = 8) {
  World world = elasticRoom();
  world.bodies[0].initial.pose.position.x() += startOff;
  return record(world, {.duration = duration}, "a scene");
}

TEST(RunDifference, sameRunsAreTheSameWhateverTheirFilesSayBeside) {
  const Trajectory run = bouncing();
  Trajectory other = run;
  other.sceneText = "another text";
  other.settings.tolerance = 1e-9;
  other.figures.energyChange = 0.5;
  other.world.walls.push_back(
      {.name = "one that nothing met", .normal = Vec3::UnitX(), .offset = -9, .material = {}});
  other.stage.name = "another name";
  const RunDifference found = differenceOf(run, other);
  EXPECT_TRUE(found.sameBits);
  EXPECT_TRUE(found.incomparable.empty());
  EXPECT_FALSE(found.firstTime || found.horizon || found.firstImpact || found.firstOtherEvent);
  EXPECT_EQ(found.worst.difference.relative, 0);
  EXPECT_EQ(found.growth.size(), kRunSamples + 1U);
  EXPECT_EQ(found.expectedEnergy, found.actualEnergy);
  EXPECT_GT(found.expectedImpacts, 5U);
}

TEST(RunDifference, ordersOfBoxesDoNotMatter) {
  const Trajectory run = driftAndReturn();
  Trajectory other = run;
  std::swap(other.tracks[0], other.tracks[1]);
  std::swap(other.world.bodies[0], other.world.bodies[1]);
  other.impacts[0].a = {1};
  const RunDifference found = differenceOf(run, other);
  EXPECT_FALSE(found.firstTime || found.firstImpact);
  EXPECT_TRUE(found.incomparable.empty());
  EXPECT_TRUE(found.sameBits);
}

TEST(RunDifference, oneBitIsSeenWhereItBegins) {
  const Trajectory run = driftAndReturn();
  Trajectory other = run;
  double& momentum = std::get<EulerStep>(other.tracks[0].segments.open()[1].motion).start.angularMomentum.z();
  momentum = std::nextafter(momentum, 1);
  const RunDifference found = differenceOf(run, other);
  EXPECT_FALSE(found.sameBits);
  EXPECT_EQ(found.firstTime, 0.5);
  EXPECT_FALSE(found.firstImpact);
}

TEST(RunDifference, firstImpactThatDiffersIsToldWithHow) {
  const Trajectory run = driftAndReturn();
  Trajectory other = run;
  other.impacts[0].impulse = 8.5;
  RunDifference found = differenceOf(run, other);
  EXPECT_FALSE(found.sameBits);
  ASSERT_TRUE(found.firstImpact);
  EXPECT_FALSE(found.firstOtherEvent);
  EXPECT_EQ(found.firstImpact->index, 0U);
  EXPECT_EQ(found.firstImpact->what, "at 0.5 s drifter against room+x with 8 N s: impulse by 0.5 N s");
  other.impacts[0].b = Partner::ofWall(0);
  found = differenceOf(run, other);
  ASSERT_TRUE(found.firstOtherEvent);
  EXPECT_EQ(found.firstOtherEvent->what,
            "expected at 0.5 s drifter against room+x with 8 N s, found at 0.5 s drifter against room-x with "
            "8.5 N s");
  other.impacts.clear();
  found = differenceOf(run, other);
  ASSERT_TRUE(found.firstOtherEvent);
  EXPECT_EQ(found.firstOtherEvent->what, "at 0.5 s drifter against room+x with 8 N s is not there");
  EXPECT_TRUE(found.firstOtherEvent->expected);
  EXPECT_FALSE(found.firstOtherEvent->actual);
  found = differenceOf(other, run);
  EXPECT_EQ(found.firstOtherEvent->what, "at 0.5 s drifter against room+x with 8 N s was not expected");
}

// A known distance: relative to the half diagonal of the box, whose sizes the runs know only by its inertia.
TEST(RunDifference, distanceIsRelativeToTheBox) {
  const Trajectory run = driftAndReturn();
  Trajectory other = run;
  std::get<EulerStep>(other.tracks[0].segments.open()[1].motion).start.pose.position.y() += 1e-3;
  const RunDifference found = differenceOf(run, other);
  EXPECT_DOUBLE_EQ(found.worst.difference.position, 1e-3);
  EXPECT_NEAR(found.worst.difference.relative, 1e-3 / std::sqrt(0.14), 1e-15);
  EXPECT_EQ(found.worst.body, "drifter");
  EXPECT_FALSE(found.horizon);
}

TEST(RunDifference, chaosHasAHorizonAndARate) {
  const Trajectory run = bouncing(0, 20);
  const RunDifference found = differenceOf(run, bouncing(1e-12, 20));
  EXPECT_EQ(found.firstTime, 0);
  ASSERT_TRUE(found.horizon);
  EXPECT_GT(*found.horizon, 3);
  EXPECT_LT(*found.horizon, 19);
  EXPECT_LT(found.worst.difference.relative, kHorizonDifference);
  EXPECT_LE(found.worst.time, *found.horizon);
  ASSERT_TRUE(found.growthPerImpact);
  EXPECT_GT(*found.growthPerImpact, 1.5);  // PHYSICS.md: about 4.3
  EXPECT_LT(*found.growthPerImpact, 10);
  ASSERT_TRUE(found.firstOtherEvent);  // the boxes hit other walls in the end
  EXPECT_GT(found.firstOtherEvent->index, 5U);
  EXPECT_EQ(found.firstImpact->index, 0U);
  EXPECT_NEAR(found.actualEnergy / found.expectedEnergy, 1, 0.9);
}

// Two boxes that go to and fro between walls, one a bit faster: time makes that difference, not impacts.
TEST(RunDifference, whatGrowsAsTimeDoesIsNoChaos) {
  const auto toAndFro = [](double speed) {
    World world = elasticRoom();
    world.bodies.resize(1);
    world.bodies[0].initial.velocity = Vec3(speed, 0, 0);
    world.bodies[0].initial.angularMomentum.setZero();
    return record(world, {.duration = 20}, "a scene");
  };
  const RunDifference found = differenceOf(toAndFro(2), toAndFro(2 + 2e-3));
  ASSERT_TRUE(found.horizon);
  EXPECT_GT(found.expectedImpacts, 10U);
  EXPECT_GT(found.worst.difference.relative, 100 * found.growth[1].difference.relative);
  EXPECT_FALSE(found.growthPerImpact);
}

TEST(RunDifference, otherBoxesCannotBeCompared) {
  const Trajectory run = driftAndReturn();
  Trajectory other = run;
  other.world.bodies[0].name = "rambler";
  const RunDifference found = differenceOf(run, other);
  EXPECT_EQ(found.incomparable,
            (std::vector<std::string>{"box drifter is not there", "box rambler was not expected"}));
  EXPECT_FALSE(found.sameBits);
}

TEST(RunDifference, shorterRunIsComparedToItsEnd) {
  const RunDifference found = differenceOf(bouncing(), bouncing(0, 3));
  EXPECT_FALSE(found.sameBits);
  EXPECT_FALSE(found.firstTime);
  EXPECT_EQ(found.growth.back().time, 3);
  EXPECT_EQ(found.worst.difference.relative, 0);
  EXPECT_TRUE(found.firstOtherEvent);
}

// The longer has bounced at the moment at which the shorter ends.
TEST(RunDifference, jumpWhereTheShorterEndsIsNoDifference) {
  const Trajectory run = driftAndReturn();
  Trajectory shorter = run;
  shorter.settings.duration = 0.5;
  shorter.tracks[0].segments.open().pop_back();
  const RunDifference found = differenceOf(run, shorter);
  EXPECT_FALSE(found.firstTime);
  EXPECT_EQ(found.worst.difference.relative, 0);
  EXPECT_EQ(found.expectedEnergy, found.actualEnergy);
  EXPECT_FALSE(found.sameBits);  // it does not last as long
  EXPECT_TRUE(differenceOf(run, shorter, 0.5).sameBits);
}

TEST(RunDifference, whatIsLaterThanAskedForDoesNotCount) {
  const Trajectory run = driftAndReturn();
  Trajectory other = run;
  std::get<EulerStep>(other.tracks[0].segments.open()[1].motion).start.velocity.x() = -3;
  other.impacts[0].impulse = 10;
  const RunDifference before = differenceOf(run, other, 0.4);
  EXPECT_TRUE(before.sameBits);
  EXPECT_EQ(before.until, 0.4);
  EXPECT_EQ(before.expectedImpacts, 0U);
  EXPECT_EQ(before.growth.back().time, 0.4);
  const RunDifference later = differenceOf(run, other, 0.6);
  EXPECT_FALSE(later.sameBits);
  EXPECT_EQ(later.firstTime, 0.5);
  EXPECT_TRUE(later.firstImpact);
  EXPECT_FALSE(differenceOf(run, other, 100).until);
}

TEST(RunDifference, aStateThatIsNoNumberIsAnError) {
  Trajectory run = driftAndReturn();
  std::get<EulerStep>(run.tracks[0].segments.open()[1].motion).start.velocity.x() =
      std::numeric_limits<double>::quiet_NaN();
  const Trajectory whole = driftAndReturn();
  EXPECT_EQ(inputErrorOf([&] { differenceOf(run, whole); }),
            "the expected run: box drifter has a state at 0.5 s that is not finite");
  EXPECT_EQ(inputErrorOf([&] { differenceOf(whole, run); }),
            "the actual run: box drifter has a state at 0.5 s that is not finite");
  EXPECT_NE(inputErrorOf([&] { differenceOf(run, run); }), "no error");
}

}  // namespace
}  // namespace careen
