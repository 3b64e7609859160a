#include "physics/impact/applied_impulses.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>

namespace careen {
namespace {

const MassProperties kCube = solidBox(Vec3::Constant(0.5), 2);

TEST(AppliedImpulses, pushAndTurnBothSides) {
  BodyState a;
  BodyState b;
  const std::array<ImpactContact, 1> contacts{
      {{.a = 0, .b = 1, .armA = Vec3(0, 1, 0), .armB = Vec3(0, 0, 2), .normal = Vec3::UnitX()}}};
  const std::array<ImpactShare, 1> shares{};
  const std::array<Vec3, 1> impulses{Vec3(4, 0, 0)};
  applyImpulses(0, {.mass = &kCube, .state = &a}, contacts, shares, impulses);
  applyImpulses(1, {.mass = &kCube, .state = &b}, contacts, shares, impulses);
  EXPECT_EQ(a.velocity, Vec3(2, 0, 0));
  EXPECT_EQ(a.angularMomentum, Vec3(0, 0, -4));
  EXPECT_EQ(b.velocity, Vec3(-2, 0, 0));
  EXPECT_EQ(b.angularMomentum, Vec3(0, -8, 0));
}

// A joint's act along its rows: here a force and a couple.
TEST(AppliedImpulses, ofJointsActAlongTheirRows) {
  auto rows = std::make_shared<ConstraintRows>();
  for (RowSide* side : {&rows->a, &rows->b}) {
    side->linear.fill(Vec3::Zero());
    side->turning.fill(Vec3::Zero());
  }
  rows->a.linear[0] = Vec3::UnitY();
  rows->a.turning[1] = Vec3(0, 0, 3);
  BodyState a;
  const std::array<ImpactContact, 1> contacts{{{.a = 0, .b = 1, .rows = rows, .holds = true}}};
  const std::array<ImpactShare, 1> shares{{{.rows = {4, 5, 0}}}};
  const std::array<Vec3, 1> unused{Vec3(9, 9, 9)};
  applyImpulses(0, {.mass = &kCube, .state = &a}, contacts, shares, unused);
  EXPECT_EQ(a.velocity, Vec3(0, 2, 0));
  EXPECT_EQ(a.angularMomentum, Vec3(0, 0, 15));
}

}  // namespace
}  // namespace careen
