#include "physics/exact/mover.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/rotation.h"
#include "support/article_equations.h"
#include "support/physics_worlds.h"
#include "support/tumbling_box.h"

namespace careen {
namespace {

const BoxSpec kTumbling = {.halfExtents = {0.1, 0.2, 0.3},
                           .position = {1, 2, 3},
                           .velocity = {4, 5, 6},
                           .angularVelocity = {1, -2, 3}};

Mover flying(const Body& body, const Vec3& gravity, double start) {
  Mover mover;
  mover.body = &body;
  mover.start = Instant(start);
  mover.fly(body.initial, Quat(body.initial.pose.worldFromBody), gravity, Vec3::Zero());
  return mover;
}

TEST(Mover, thatFliesIsWhereTheMotionFlightHasIt) {
  const Body body = makeBox(kTumbling);
  const Mover mover = flying(body, Vec3(0, 0, -9.81), 2);
  EXPECT_TRUE(mover.flies());
  EXPECT_TRUE(mover.moves());
  EXPECT_FALSE(mover.steps());
  for (const double time : {2.0, 2.5, 7.0}) {
    const BodyState state = mover.stateAt(Instant(time));
    const BodyState expected = stateAt(Motion(mover.flight), body.mass, time - 2);
    EXPECT_EQ(state.pose.position, expected.pose.position);
    EXPECT_EQ(state.pose.worldFromBody, expected.pose.worldFromBody);
    EXPECT_EQ(state.velocity, expected.velocity);
    EXPECT_EQ(state.angularMomentum, expected.angularMomentum);
    EXPECT_EQ(mover.positionAt(Instant(time)), expected.pose.position);
    EXPECT_EQ(mover(time - 2).worldFromBody, expected.pose.worldFromBody);
    EXPECT_LT((mover(time - 2).angularVelocity - angularVelocity(body.mass, expected)).norm(), 1e-14);
  }
}

TEST(Mover, thatFliesKeepsWithinItsBounds) {
  test::Dice dice(3);
  for (int k = 0; k < 200; ++k) {
    BoxSpec spec = kTumbling;
    spec.angularVelocity = dice.vector(5);
    const Body body = makeBox(spec);
    const Mover mover = flying(body, Vec3::Zero(), 0);
    for (int i = 0; i < 20; ++i) {
      const double t = dice.between(0, 20);
      const double h = 1e-5;
      const Vec3 omega = mover(t).angularVelocity;
      EXPECT_LE(omega.norm(), mover.bounds.angularSpeed);
      EXPECT_LE((mover(t + h).angularVelocity - mover(t - h).angularVelocity).norm() / (2 * h),
                mover.bounds.angularAcceleration * (1 + 1e-6) + 1e-8);
    }
  }
}

TEST(Mover, thatRestsStandsAndForgetsItsFlight) {
  const Body body = makeBox(kTumbling);
  Mover mover = flying(body, Vec3(0, 0, -9.81), 0);
  mover.wall = Event{};
  mover.crosses = true;
  const Pose at{.position = {7, 8, 9}, .worldFromBody = axisAngle(Vec3::UnitX(), 0.5)};
  mover.rest(at);
  EXPECT_FALSE(mover.moves());
  EXPECT_FALSE(mover.wall.has_value());
  EXPECT_FALSE(mover.crosses);
  EXPECT_EQ(mover.bounds.angularSpeed, 0);
  const BodyState state = mover.stateAt(Instant(100));
  EXPECT_EQ(state.pose.position, at.position);
  EXPECT_EQ(state.pose.worldFromBody, at.worldFromBody);
  EXPECT_EQ(state.velocity, Vec3::Zero());
  EXPECT_EQ(mover(3).worldFromBody, at.worldFromBody);
  EXPECT_EQ(mover(3).angularVelocity, Vec3::Zero());
}

// The search's clock is 0 at a moment of the world's, 3 s into the flight.
TEST(Mover, isSeenByTheSearchFromAnyMomentOn) {
  const Body body = makeBox(kTumbling);
  const Mover mover = flying(body, Vec3(0, 0, -9.81), 2);
  const MovingBox box = mover.moving(Instant(5), 0, Instant(100));
  EXPECT_EQ(box.age, 3);
  EXPECT_EQ(box.halfExtents, body.halfExtents);
  EXPECT_EQ(box.positionAt(0.5), mover.positionAt(Instant(5.5)));
  EXPECT_EQ(box.velocityAt(0.5), mover.stateAt(Instant(5.5)).velocity);
  EXPECT_EQ(box.attitude(3.5).worldFromBody, mover.stateAt(Instant(5.5)).pose.worldFromBody);
  EXPECT_EQ(box.step, nullptr);
}

// Cubes of half size 0.2 side by side: 0.4 m from centre to centre they touch, with 0.01 m more only if told.
TEST(Mover, touchesAnotherWithinRoundingOrTheGapAllowed) {
  const Body cube = makeBox({});
  const auto touching = [&](double distance, double apart) {
    return areTouching({Pose{}, cube.halfExtents}, {Pose{.position = {distance, 0, 0}}, cube.halfExtents},
                       apart);
  };
  EXPECT_TRUE(touching(0.4, 0));
  EXPECT_TRUE(touching(0.3, 0));
  EXPECT_FALSE(touching(0.401, 0));
  EXPECT_TRUE(touching(0.401, 0.01));
  EXPECT_FALSE(touching(0.411, 0.01));
  EXPECT_FALSE(touching(5, 0.01));
}

}  // namespace
}  // namespace careen
