#include "physics/motion/motion.h"

#include <gtest/gtest.h>

#include <cmath>

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

SampledStep someRows(const Body& body, double seconds, const Vec3& spin) {
  SampledStep step{.duration = seconds, .start = body.initial, .end = body.initial};
  step.end.pose.position += Vec3(0.1, -0.2, 0.3);
  step.end.pose.worldFromBody =
      axisAngle(spin.normalized(), seconds * spin.norm()) * step.start.pose.worldFromBody;
  step.end.velocity = Vec3(3, 2, 1);
  step.start.angularMomentum = angularMomentum(body.mass, step.start.pose.worldFromBody, spin);
  step.end.angularMomentum = angularMomentum(body.mass, step.end.pose.worldFromBody, spin);
  return step;
}

TEST(Motion, betweenRowsOfATableHasTheRowsToTheBit) {
  const Body body = makeBox({.worldFromBody = axisAngle(Vec3(2, -1, 2) / 3, 1.1), .velocity = {1, 2, 3}});
  const SampledStep step = someRows(body, 0.01, Vec3(3, -1, 2));
  for (const auto& [elapsed, expected] : {std::pair(0.0, step.start), std::pair(0.01, step.end)}) {
    const BodyState state = stateAt(step, body.mass, elapsed);
    EXPECT_EQ(state.pose.position, expected.pose.position);
    EXPECT_EQ(state.pose.worldFromBody, expected.pose.worldFromBody);
    EXPECT_EQ(state.velocity, expected.velocity);
    EXPECT_EQ(state.angularMomentum, expected.angularMomentum);
  }
}

// A steady spin of up to 0.9 rad between the rows, and velocities that are derivatives of positions.
TEST(Motion, betweenRowsOfATableIsSmooth) {
  const Body body = makeBox({.worldFromBody = axisAngle(Vec3(2, -1, 2) / 3, 1.1), .velocity = {1, 2, 3}});
  const Vec3 spin(30, -10, 20);
  for (const double seconds : {0.002, 0.024}) {
    const SampledStep step = someRows(body, seconds, spin);
    const double half = 0.5 * seconds;
    const Mat3 turned = axisAngle(spin.normalized(), half * spin.norm()) * step.start.pose.worldFromBody;
    const BodyState state = stateAt(step, body.mass, half);
    EXPECT_LT((state.pose.worldFromBody - turned).norm(),
              1e-3 * std::pow(seconds / 0.024, 4));  // measured 2.4e-4
    const double h = 1e-6;
    const Vec3 slope = (stateAt(step, body.mass, half + h).pose.position -
                        stateAt(step, body.mass, half - h).pose.position) /
                       (2 * h);
    EXPECT_LT((slope - state.velocity).norm(), 1e-6 * (1 + slope.norm()));
  }
}

// Half a turn and more, an impact, quaternions of opposite sign: no state is undefined.
TEST(Motion, betweenRowsOfATableThatDisagreeIsDefined) {
  const Body body = makeBox({.worldFromBody = axisAngle(Vec3(2, -1, 2) / 3, 1.1), .velocity = {1, 2, 3}});
  for (int k = 0; k < 1000; ++k) {
    const Vec3 axis = Vec3(std::sin(k), std::cos(2 * k), std::sin(3 * k + 1)).normalized();
    SampledStep step = someRows(body, 0.1, 0.1 * k * axis);
    step.end.angularMomentum *= k % 3 - 1;
    for (int part = 0; part <= 8; ++part) {
      const BodyState state = stateAt(step, body.mass, 0.0125 * part);
      EXPECT_LT((state.pose.worldFromBody * state.pose.worldFromBody.transpose() - Mat3::Identity()).norm(),
                1e-12);
    }
  }
}

// Bit for bit what the polynomial of degree 5 with zeros has, signs of zero too.
TEST(Motion, ofACrowdIsThatOfItsCubics) {
  CrowdStep step{.duration = 0.3};
  step.position = {Vec3(1, -0.0, 3), Vec3(0.2, -0.0, -0.1), Vec3(0.01, -0.0, 0.3), Vec3(-0.02, -0.0, 0.1)};
  step.worldFromBody = {Vec4(0, 0, 0, 1), Vec4(0.1, -0.2, 0.05, 0), Vec4(0, 0.01, -0.0, 0.02), Vec4::Zero()};
  const MassProperties mass = solidBox(Vec3(0.1, 0.2, 0.3), 2);
  for (const double elapsed : {0.0, 0.1, 0.3}) {
    const BodyState state = stateAt(step, mass, elapsed);
    const BodyState full = stateAt(asContactStep(step), mass, elapsed);
    EXPECT_EQ(state.pose.position, full.pose.position);
    EXPECT_EQ(std::signbit(state.pose.position.y()), std::signbit(full.pose.position.y()));
    EXPECT_EQ(std::signbit(state.velocity.y()), std::signbit(full.velocity.y()));
    EXPECT_EQ(state.velocity, full.velocity);
    EXPECT_EQ(state.pose.worldFromBody, full.pose.worldFromBody);
    EXPECT_EQ(state.angularMomentum, full.angularMomentum);
  }
}

}  // namespace
}  // namespace careen
