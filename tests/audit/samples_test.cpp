#include "audit/samples.h"

#include <gtest/gtest.h>

#include "support/trajectories.h"

namespace careen {
namespace {

TEST(Samples, areTheStatesOfTheRun) {
  const Trajectory run = driftAndReturn();
  const Samples samples(run, {0, 0.25, 0.5, 0.75, 1});
  for (std::size_t moment = 0; moment < samples.moments(); ++moment) {
    for (std::size_t body = 0; body < 2; ++body) {
      const BodyState expected = run.state(body, samples.times()[moment]);
      EXPECT_EQ(samples.state(moment, body).pose.position, expected.pose.position);
      EXPECT_EQ(samples.state(moment, body).velocity, expected.velocity);
    }
  }
}

TEST(Samples, centresAreThoseOfTheStates) {
  Flight flight;
  flight.velocity = Vec3(1, 2, 3);
  flight.acceleration = Vec3(0, 0, -9.81);
  ContactStep step{.duration = 0.5};
  step.position.fill(Vec3(1, -1, 2));
  step.worldFromBody.fill(Vec4::Zero());
  step.worldFromBody[0] = Vec4(0, 0, 0, 1);
  EulerStep euler;
  euler.start.velocity = Vec3(1, 0, 2);
  const SteppedFlight stepped{.method = Method::kStrang, .dt = 0.01, .start = flight};
  const MassProperties mass = solidBox(Vec3(1, 2, 3), 1);
  for (const Motion& motion :
       {Motion(Rest{}), Motion(flight), Motion(step), Motion(euler), Motion(stepped)}) {
    EXPECT_EQ(centerAt(motion, 0.2), stateAt(motion, mass, 0.2).pose.position) << motion.index();
  }
}

TEST(Samples, theLaterSegmentCountsWhereTwoMeet) {
  const Trajectory run = driftAndReturn();
  EXPECT_EQ(segmentAt(run.tracks[0], 0.4999), 0U);
  EXPECT_EQ(segmentAt(run.tracks[0], 0.5), 1U);
  EXPECT_EQ(segmentAt(run.tracks[0], 1), 1U);
}

TEST(Samples, everyNumberOfAMotionMustBeFinite) {
  Flight flight;
  ContactStep step{.duration = 1};
  step.position.fill(Vec3::Zero());
  step.worldFromBody.fill(Vec4::Zero());
  EXPECT_TRUE(isFinite(flight));
  EXPECT_TRUE(isFinite(step));
  EXPECT_TRUE(isFinite(Rest{}));
  flight.worldFromBody.y() = NAN;
  step.worldFromBody[5].y() = INFINITY;
  EulerStep euler;
  euler.torque.z() = NAN;
  EXPECT_FALSE(isFinite(flight));
  EXPECT_FALSE(isFinite(step));
  EXPECT_FALSE(isFinite(euler));
  EXPECT_FALSE(isFinite(SteppedFlight{.start = flight}));
}

TEST(Samples, whatFliesDoesNotTouch) {
  EXPECT_TRUE(mayTouch(Rest{}));
  EXPECT_TRUE(mayTouch(ContactStep{}));
  EXPECT_FALSE(mayTouch(Flight{}));
  EXPECT_FALSE(mayTouch(EulerStep{}));
}

}  // namespace
}  // namespace careen
