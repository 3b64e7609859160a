#include "physics/motion/hermite_step.h"

#include <gtest/gtest.h>

#include "physics/world/body.h"

namespace careen {
namespace {

TEST(HermiteStep, passesThroughBothEndsWithTheirVelocities) {
  const MassProperties mass = solidBox({0.1, 0.2, 0.3}, 2);
  const StepEnd from{.position = {1, 2, 3},
                     .velocity = {0.5, -1, 2},
                     .acceleration = {0, 0, -9.8},
                     .worldFromBody = Quat(0.8, 0.2, -0.4, 0.4).normalized(),
                     .spinBody = {1, 2, -3},
                     .spinRateBody = {4, 0, 1}};
  const StepEnd to{.position = {1.1, 1.9, 3.3},
                   .velocity = {0.4, -1.1, 1.9},
                   .acceleration = {1, 0, -9},
                   .worldFromBody = Quat(0.82, 0.25, -0.35, 0.38).normalized(),
                   .spinBody = {1.1, 2.2, -2.9},
                   .spinRateBody = {3, 1, 1}};
  const double length = 0.125;
  const Motion motion = hermiteStep(from, to, length);
  for (const StepEnd* end : {&from, &to}) {
    const BodyState at = stateAt(motion, mass, end == &from ? 0 : length);
    EXPECT_LT((at.pose.position - end->position).norm(), 1e-14);
    EXPECT_LT((at.velocity - end->velocity).norm(), 1e-13);
    EXPECT_LT((at.pose.worldFromBody - end->worldFromBody.toRotationMatrix()).norm(), 1e-14);
    const Vec3 spin = at.pose.worldFromBody.transpose() * angularVelocity(mass, at);
    EXPECT_LT((spin - end->spinBody).norm(), 1e-12);
  }
}

// A parabola is a polynomial of degree 2: nothing is left to interpolate.
TEST(HermiteStep, isExactForConstantAcceleration) {
  const Vec3 gravity(0, 0, -9.81);
  const Vec3 velocity(1, 2, 3);
  const double length = 0.25;
  const StepEnd from{.velocity = velocity, .acceleration = gravity};
  const StepEnd to{.position = length * velocity + 0.5 * length * length * gravity,
                   .velocity = velocity + length * gravity,
                   .acceleration = gravity};
  const Motion motion = hermiteStep(from, to, length);
  const MassProperties mass = solidBox({0.1, 0.1, 0.1}, 1);
  for (const double time : {0.05, 0.1, 0.2}) {
    const Vec3 expected = time * velocity + 0.5 * time * time * gravity;
    EXPECT_LT((stateAt(motion, mass, time).pose.position - expected).norm(), 1e-15);
  }
}

}  // namespace
}  // namespace careen
