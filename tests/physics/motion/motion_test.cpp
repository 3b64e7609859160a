#include "physics/motion/motion.h"

#include <gtest/gtest.h>

#include "core/math/rotation.h"
#include "physics/motion/listing1.h"
#include "support/article_equations.h"
#include "support/physics_worlds.h"

namespace careen {
namespace {

TEST(Motion, atRestStaysWhereItIs) {
  Rest rest;
  rest.pose = {.position = {1, 2, 3}, .worldFromBody = axisAngle(Vec3::UnitZ(), 0.5)};
  const BodyState state = stateAt(rest, immovable(), 1e6);
  EXPECT_EQ(state.pose.position, rest.pose.position);
  EXPECT_EQ(state.pose.worldFromBody, rest.pose.worldFromBody);
  EXPECT_EQ(state.velocity, Vec3::Zero());
  EXPECT_EQ(state.angularMomentum, Vec3::Zero());
}

EulerStep someStep(const Body& body) {
  return {.start = body.initial, .force = {1, 2, 3}, .torque = {0.1, -0.2, 0.3}};
}

TEST(Motion, ofAnEulerStepIsAStepOfThatLength) {
  const Body body = makeBox({.worldFromBody = axisAngle(Vec3(2, -1, 2) / 3, 1.1),
                             .velocity = {1, 2, 3},
                             .angularVelocity = {3, -1, 2}});
  const EulerStep step = someStep(body);
  for (const double elapsed : {1e-3, 0.1}) {
    const BodyState expected =
        listing1Step(body.mass, body.initial, {.force = step.force, .torque = step.torque}, elapsed);
    const BodyState state = stateAt(step, body.mass, elapsed);
    EXPECT_EQ(state.pose.position, expected.pose.position);
    EXPECT_EQ(state.pose.worldFromBody, expected.pose.worldFromBody);
    EXPECT_EQ(state.velocity, expected.velocity);
    EXPECT_EQ(state.angularMomentum, expected.angularMomentum);
  }
}

// The orientation is off by its last bits, as orientations are: the start of a step leaves them alone.
TEST(Motion, ofAnEulerStepBeginsInItsStartToTheBit) {
  Body body = makeBox({.worldFromBody = axisAngle(Vec3(2, -1, 2) / 3, 1.1)});
  body.initial.pose.worldFromBody(0, 0) += 1e-15;
  ASSERT_NE(orthonormalizeFromColumn0(body.initial.pose.worldFromBody), body.initial.pose.worldFromBody);
  const BodyState state = stateAt(someStep(body), body.mass, 0);
  EXPECT_EQ(state.pose.worldFromBody, body.initial.pose.worldFromBody);
}

}  // namespace
}  // namespace careen
