#include "physics/contact/touching_group.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/touching_bodies.h"

namespace careen {
namespace {

// I = ⅔ m a² = 1/150 kg m² about every axis.
TEST(TouchingGroup, turnsByItsAngularMomentumUnlessHeld) {
  World world = cubeAbove(1, Vec3(3, 0, 4));
  world.bodies.push_back(box("held", Vec3(0.1, 0.1, 0.1), 1, Vec3(0, 0, 2)));
  world.bodies[1].mass = immovable();
  GroupOf of(world);
  of.state[0].angularMomentum = Vec3(0, 0.02, 0);
  of.state[1].velocity = Vec3(9, 9, 9);
  const Kinematics free = of.group.kinematics(0, of.state[0]);
  EXPECT_LT((free.angularVelocity - Vec3(0, 3, 0)).norm(), 1e-15);
  EXPECT_EQ(of.group.kinematics(1, of.state[1]).velocity, Vec3::Zero());
  EXPECT_NEAR(of.group.fastest(of.state), 5 + 3 * std::sqrt(0.03), 1e-14);
}

// Their corners reach √0.03 m from the middles.
TEST(TouchingGroup, bodiesMayMeetWithinTheirRadii) {
  World world = cubeAbove(1);
  world.bodies.push_back(box("other", Vec3(0.1, 0.1, 0.1), 1, Vec3(0.5, 0, 1)));
  const GroupOf of(world);
  const double apart = 0.5 - 2 * std::sqrt(0.03);
  EXPECT_TRUE(of.group.mayMeet(0, 1, of.state, apart + 1e-9));
  EXPECT_FALSE(of.group.mayMeet(0, 1, of.state, apart - 1e-9));
}

// A corner 1 mm above a corner: both arms end halfway.
TEST(TouchingGroup, aPairHasOnePointForBoth) {
  World world = cubeAbove(0.201, Vec3(0, 0, -2));
  world.bodies.push_back(box("lower", Vec3(0.1, 0.1, 0.1), 1, Vec3(-0.2, -0.2, 0)));
  GroupOf of(world);
  const std::vector<ContactFeature> features{{.kind = ContactFeature::Kind::kInCone,
                                              .a = 0,
                                              .b = 1,
                                              .onA = Vec3(-0.1, -0.1, -0.1),
                                              .onB = Vec3(0.1, 0.1, 0.1),
                                              .axisA = ContactFeature::kNoEdge,
                                              .axisB = ContactFeature::kNoEdge,
                                              .normalA = Vec3::UnitZ(),
                                              .normalB = Vec3::UnitZ()}};
  const ContactState at = of.group.contactAt(features[0], of.state);
  EXPECT_NEAR(at.gap, 1e-3, 1e-15);
  EXPECT_NEAR(at.rate, -2, 1e-15);
  const Vec3 halfway(-0.1, -0.1, 0.1005);
  EXPECT_LT((of.state[0].position + at.armA - halfway).norm(), 1e-15);
  EXPECT_LT((of.state[1].position + at.armB - halfway).norm(), 1e-15);
  std::vector<ContactState> all;
  of.group.contactsAt(features, of.state, all);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].gap, at.gap);
}

// Two bodies that push each other fall as one: after 0.1 s with 1 m/s less each, 0.05 m lower.
TEST(TouchingGroup, momentaThatAStepLostAreGivenBack) {
  World world = cubeAbove(1, Vec3(1, 0, 0));
  world.bodies.push_back(box("other", Vec3(0.1, 0.1, 0.1), 3, Vec3(0.2, 0, 1)));
  const GroupOf of(world);
  const ContactFeature between{.kind = ContactFeature::Kind::kPointOnFace, .b = 1};
  GroupState to = of.state;
  of.group.keepMomenta(of.state, 0.1, std::vector<ContactFeature>{between}, to);
  const Vec3 momentum = to[0].velocity + 3 * to[1].velocity;
  EXPECT_LT((momentum - Vec3(1, 0, -4)).norm(), 1e-14);
  const Vec3 center = (to[0].position + 3 * to[1].position) / 4;
  EXPECT_LT((center - Vec3(0.15 + 0.025, 0, 0.95)).norm(), 1e-14);
  GroupState onFloor = of.state;
  of.group.keepMomenta(of.state, 0.1, lowerCorners(world), onFloor);  // the other one is alone
  EXPECT_EQ(onFloor[0].velocity, of.state[0].velocity);
  EXPECT_LT((onFloor[1].velocity - Vec3(0, 0, -1)).norm(), 1e-15);
}

}  // namespace
}  // namespace careen
