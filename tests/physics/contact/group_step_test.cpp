#include "physics/contact/group_step.h"

#include <gtest/gtest.h>

#include "support/touching_bodies.h"

namespace careen {
namespace {

GroupState at(double place, double speed) {
  return {{.position = Vec3(place, 0, 1), .velocity = Vec3(speed, 0, 0)}};
}

// From 1 m/s to rest in 0.5 s: x = t − t².
TEST(GroupStep, oneStepIsAParabola) {
  const GroupOf of(cubeAbove(1));
  const GroupStep step{.length = 0.5, .start = at(0, 1), .end = at(0.25, 0)};
  const GroupPath path(of.group, step);
  for (const double time : {0.1, 0.2, 0.4}) {
    EXPECT_NEAR(path.at(0, time).position.x(), time - time * time, 1e-15);
    EXPECT_NEAR(path.at(0, time).velocity.x(), 1 - 2 * time, 1e-15);
  }
}

// Two of half the length: −1.6 m/s² at the start, −2.4 m/s² at the end.
TEST(GroupStep, twoHalvesHaveAnAccelerationEach) {
  const GroupOf of(cubeAbove(1));
  const GroupStep step{.length = 0.5, .start = at(0, 1), .end = at(0.275, 0), .middle = at(0.2, 0.6)};
  const ContactStep motion = step.motion(of.bodies[0], 0);
  EXPECT_NEAR(2 * motion.position[2].x() / 0.25, -1.6, 1e-14);
  double bend = 0;  // p″ at s = 1
  for (std::size_t k = 2; k < 6; ++k) {
    bend += static_cast<double>(k * (k - 1)) * motion.position[k].x();
  }
  EXPECT_NEAR(bend / 0.25, -2.4, 1e-13);
}

// Flight under 12 t m/s²: x = 2 t³, which the polynomials have to rounding. What is at rest in the first half
// does not go back before it sets out in the second, from 0 m/s by 2 t³ later.
TEST(GroupStep, bendsAsGravityDoesWhereItSlopes) {
  const GroupOf of(cubeAbove(1));
  GroupStep step{.length = 0.5,
                 .start = at(0, 0),
                 .end = at(0.25, 1.5),
                 .middle = at(0.03125, 0.375),
                 .slope = Vec3(12, 0, 0)};
  for (const double time : {0.1, 0.2, 0.4}) {
    const GroupBody body = GroupPath(of.group, step).at(0, time);
    EXPECT_NEAR(body.position.x(), 2 * time * time * time, 1e-16);
    EXPECT_NEAR(body.velocity.x(), 6 * time * time, 1e-15);
  }
  step.middle = at(0, 0);
  step.end = at(0.0234375, 0.375);
  EXPECT_EQ(step.motion(of.bodies[0], 0).position[2].x(), 0);
}

// A quarter of a turn about z, the quaternion of the end with the other sign.
TEST(GroupStep, turnsTheShortWay) {
  const GroupOf of(cubeAbove(1));
  GroupStep step{.length = 1, .start = at(0, 0), .end = at(0, 0)};
  step.end[0].worldFromBody = Quat(-std::sqrt(0.5), 0, 0, -std::sqrt(0.5));
  const GroupPath path(of.group, step);
  const Vec3 turned = path.at(0, 0.5).worldFromBody * Vec3::UnitX();
  EXPECT_GT(turned.x(), 0.7);
  EXPECT_GT(turned.y(), 0.7);
}

TEST(GroupStep, itsEndsAreItsStates) {
  World world = cubeAbove(1);
  world.bodies.push_back(box("held", Vec3(0.1, 0.1, 0.1), 1, Vec3(3, 0, 1)));
  world.bodies[1].mass = immovable();
  const GroupOf of(world);
  GroupStep step{.length = 0.3, .start = of.state, .end = of.state};
  step.end[0].position = Vec3(0.1, 0.2, 0.3);
  step.end[0].worldFromBody = Quat(1, 1e-9, 0, 0);  // as it is, not normalized
  const GroupPath path(of.group, step);
  EXPECT_EQ(path.atOrEnd(0, 0.3).worldFromBody.coeffs(), step.end[0].worldFromBody.coeffs());
  EXPECT_EQ(path.atOrEnd(0, 0).position, of.state[0].position);
  EXPECT_EQ(path.at(1, 0.2).position, Vec3(3, 0, 1));
}

}  // namespace
}  // namespace careen
