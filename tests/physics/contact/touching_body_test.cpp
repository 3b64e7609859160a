#include "physics/contact/touching_body.h"

#include <gtest/gtest.h>

#include <array>

namespace careen {
namespace {

TouchingBody drivenBody(const Body& body, const CoursePart& part) {
  return {.body = &body, .drivenBy = &part};
}

// At any time it is where its part says, as a state and as a motion.
TEST(TouchingBody, isWhereItIsDriven) {
  Body body;
  body.halfExtents = Vec3::Constant(0.5);
  const CoursePart part{.from = 1, .motion = {.velocity = Vec3(2, 0, 0), .spin = Vec3(0, 0, 3)}};
  const TouchingBody at = drivenAt(drivenBody(body, part), 1.5);
  EXPECT_EQ(at.position, Vec3(1, 0, 0));
  EXPECT_EQ(at.state().velocity, Vec3(2, 0, 0));
  EXPECT_LT((at.state().angularMomentum - Vec3(0, 0, 3)).norm(), 1e-15);  // of what is held, its ω
  EXPECT_LT((angularVelocity(body.mass, at.state()) - Vec3(0, 0, 3)).norm(), 1e-15);
  EXPECT_TRUE(at.kinematics().isDriven);
  EXPECT_LT((at.kinematics().pose.worldFromBody - at.worldFromBody.toRotationMatrix()).norm(), 1e-15);
}

// The corner of a cube that turns, at √3/2 m: ω² r = 9 √3/2 m/s².
TEST(TouchingBody, accelerationsAreThoseOfCorners) {
  Body body;
  body.halfExtents = Vec3::Constant(0.5);
  const CoursePart part{.motion = {.spin = Vec3(0, 0, 3)}};
  EXPECT_NEAR(drivenAcceleration(std::array{TouchingBody{.body = &body}, drivenBody(body, part)}),
              9 * std::sqrt(0.75), 1e-14);
  EXPECT_EQ(drivenAcceleration(std::array{TouchingBody{.body = &body}}), 0);
}

}  // namespace
}  // namespace careen
