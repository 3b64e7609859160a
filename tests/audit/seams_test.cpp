#include "audit/seams.h"
#include "audit/samples.h"

#include <gtest/gtest.h>

#include <limits>
#include <utility>

#include "support/trajectories.h"

namespace careen {
namespace {

TEST(Seams, segmentsThatBeginTogetherAreOneSeam) {
  Track track;
  for (const double start : {0.0, 0.0, 1.0, 1.0, 1.0, 2.0}) {
    track.segments.open().push_back({.start = start, .motion = Rest{}});
  }
  const std::vector<Seam> seams = seamsOf(track);
  ASSERT_EQ(seams.size(), 2U);
  EXPECT_EQ(seams[0].before, 1U);
  EXPECT_EQ(seams[0].after, 4U);
  EXPECT_EQ(seams[1].before, 4U);
  EXPECT_EQ(seams[1].after, 5U);
}

TEST(Seams, impactsGoToBothBodies) {
  Trajectory run = driftAndReturn();
  run.impacts.push_back(run.impacts.front());
  run.impacts.back().b = Partner::ofBody(1);
  const auto impulses = impulsesOfBodies(run);
  EXPECT_EQ(impulses[0].impacts, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(impulses[1].impacts, (std::vector<std::size_t>{1}));
}

TEST(Seams, impulsesOfJointsGoToBothEnds) {
  Trajectory run = driftAndReturn();
  run.world.joints = {{.name = "leash", .from = {.body = 1}, .to = {}},
                      {.name = "stick", .from = {.body = 1}, .to = {.body = 0}}};
  run.jointImpulses = {{.joint = 1}, {.joint = 0}};
  const auto impulses = impulsesOfBodies(run);
  EXPECT_EQ(impulses[0].joints, (std::vector<std::size_t>{0}));
  EXPECT_EQ(impulses[1].joints, (std::vector<std::size_t>{0, 1}));
}

Findings checked(const Trajectory& run) {
  Findings findings(run.settings, crowdBeginnings(run));
  const std::vector<Seam> seams = seamsOf(run.tracks[0]);
  EXPECT_EQ(seams.size(), 1U);
  checkSeam(run, 0, seams.at(0), impulsesOfBodies(run)[0], fallingSpeeds(run.world)[0], findings);
  return findings;
}

// The drifter of 2 kg turns from 2 to -2 m/s by 8 N s at a point a tenth of its centre's height aside, which
// gives no turn; that it has one afterwards is what the run was made with.
TEST(Seams, impulsesMustGiveTheJumpOfTheVelocity) {
  Trajectory run = driftAndReturn();
  std::get<EulerStep>(run.tracks[0].segments.open()[1].motion).start.angularMomentum.setZero();
  run.impacts[0].point = Vec3(2, 0, 0);
  EXPECT_EQ(checked(run).largest(AuditKind::kImpulse).size, 0);
  EXPECT_EQ(checked(run).largest(AuditKind::kContinuity).size, 0);
  run.impacts[0].impulse = 6;  // 2 of 8 N s too few
  EXPECT_NEAR(checked(run).largest(AuditKind::kImpulse).size, 2. / (4 + 6), 1e-12);
  run.impacts[0].tangential = 1.5;  // friction may point anywhere
  EXPECT_NEAR(checked(run).largest(AuditKind::kImpulse).size, 0.5 / (4 + 7.5), 1e-12);
}

// The same 8 N s by a joint, at a point 1 m above the centre of mass, (2, 0, 0): (0, 0, 1) × (-8, 0, 0) is
// (0, -8, 0) N m s, which a couple of (0, 8, 1/3) turns into what the run was made with. The drifter is the
// joint's second end: on it acts the opposite.
TEST(Seams, impulsesOfJointsGiveAJumpToo) {
  Trajectory run = driftAndReturn();
  run.impacts.clear();
  run.world.joints = {{.name = "stick", .from = {.body = 1}, .to = {.body = 0}}};
  run.jointImpulses = {
      {.time = 0.5, .joint = 0, .point = {2, 0, 1}, .linear = {8, 0, 0}, .angular = {0, -8, -1. / 3}}};
  EXPECT_NEAR(checked(run).largest(AuditKind::kImpulse).size, 0, 1e-15);
  std::swap(run.world.joints[0].from, run.world.joints[0].to);
  run.jointImpulses[0].linear *= -1;
  run.jointImpulses[0].angular *= -1;
  EXPECT_NEAR(checked(run).largest(AuditKind::kImpulse).size, 0, 1e-15);
  run.jointImpulses[0].linear *= 0.75;  // 2 of 8 N s too few, of 4 before and 6 given
  run.jointImpulses[0].angular.y() *= 0.75;
  EXPECT_NEAR(checked(run).largest(AuditKind::kImpulse).size, 2. / (4 + 6), 1e-12);
  run.jointImpulses[0].time = 0.75;  // too late
  EXPECT_NEAR(checked(run).largest(AuditKind::kImpulse).size, 8. / 4, 1e-12);
}

TEST(Seams, aTurnThatNoImpactGaveIsFound) {
  EXPECT_GT(checked(driftAndReturn()).largest(AuditKind::kImpulse).size, 0.01);
}

TEST(Seams, jumpsAreInMetresOfTheFarthestPoint) {
  Trajectory run = driftAndReturn();
  EulerStep& back = std::get<EulerStep>(run.tracks[0].segments.open()[1].motion);
  back.start.pose.position.y() += 1e-3;
  EXPECT_NEAR(checked(run).largest(AuditKind::kContinuity).size, 1e-3, 1e-9);
  back.start.pose.position.y() -= 1e-3;
  back.start.pose.worldFromBody = Eigen::AngleAxisd(1e-3, Vec3::UnitZ()).toRotationMatrix();
  EXPECT_NEAR(checked(run).largest(AuditKind::kContinuity).size,
              1e-3 * run.world.bodies[0].halfExtents.head<2>().norm(), 1e-8);
}

TEST(Seams, statesMustBeFiniteAndRotations) {
  Findings findings({.tolerance = 1e-6}, {std::numeric_limits<double>::infinity()});
  BodyState state;
  checkState(state, 0, 1, findings);
  EXPECT_EQ(findings.largest(AuditKind::kOrthogonality).size, 0);
  state.pose.worldFromBody(0, 0) = 1.5;
  checkState(state, 0, 1, findings);
  EXPECT_NEAR(findings.largest(AuditKind::kOrthogonality).size, 1.25, 1e-15);
  state.velocity.x() = INFINITY;
  checkState(state, 0, 2, findings);
  EXPECT_EQ(findings.largest(AuditKind::kNotFinite).time, 2);
}

}  // namespace
}  // namespace careen
