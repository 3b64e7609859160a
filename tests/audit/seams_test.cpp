#include "audit/seams.h"
#include "audit/samples.h"

#include <gtest/gtest.h>

#include <limits>

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
  const auto impacts = impactsOfBodies(run);
  EXPECT_EQ(impacts[0], (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(impacts[1], (std::vector<std::size_t>{1}));
}

Findings checked(const Trajectory& run) {
  Findings findings(run.settings, crowdBeginnings(run));
  const std::vector<Seam> seams = seamsOf(run.tracks[0]);
  EXPECT_EQ(seams.size(), 1U);
  checkSeam(run, 0, seams.at(0), impactsOfBodies(run)[0], fallingSpeeds(run.world)[0], findings);
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
