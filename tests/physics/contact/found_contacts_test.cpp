#include "physics/contact/found_contacts.h"

#include <gtest/gtest.h>

#include <vector>

#include "support/touching_bodies.h"

namespace careen {
namespace {

constexpr double kClosedGap = 1e-6;

TEST(FoundContacts, ofACubeOnTheFloorAreItsLowerCorners) {
  GroupOf of(cubeAbove(0.1 - 3e-7));
  FoundContacts found(of.group, kClosedGap);
  found.find(of.state, 0);
  ASSERT_EQ(found.features().size(), 4U);
  EXPECT_NEAR(found.deepest(), 3e-7, 1e-15);
  for (const ContactFeature& feature : found.features()) {
    EXPECT_EQ(feature.onA.z(), -0.1);
    EXPECT_EQ(feature.b, 1);  // the floor
    EXPECT_TRUE(found.has(feature));
  }
  EXPECT_FALSE(found.has({.a = 0, .b = 1, .onA = Vec3(0.1, 0.1, 0.1)}));
}

TEST(FoundContacts, endWhereGapsBegin) {
  for (const double gap : {0.999e-6, 1.001e-6}) {
    GroupOf of(cubeAbove(0.1 + gap));
    FoundContacts found(of.group, kClosedGap);
    found.find(of.state, 0);
    EXPECT_EQ(found.features().size(), gap < kClosedGap ? 4U : 0U);
    EXPECT_EQ(found.deepest(), 0);
  }
}

TEST(FoundContacts, areFollowedToOtherStates) {
  GroupOf of(cubeAbove(0.1));
  FoundContacts found(of.group, kClosedGap);
  found.find(of.state, 0);
  of.state[0].position.z() = 0.13;
  of.state[0].velocity.z() = -2;
  found.follow(of.state);
  ASSERT_EQ(found.states().size(), 4U);
  EXPECT_NEAR(found.states()[0].gap, 0.03, 1e-16);
  EXPECT_EQ(found.rate(0), -2);
}

// Two cubes face to face meet at four corners, a third one diagonally next to them at none.
TEST(FoundContacts, ofTwoCubesAreTheCornersOfTheirFaces) {
  World world;
  for (const Vec3& at : {Vec3(0, 0, 0), Vec3(0.2, 0.03, 0), Vec3(0, 0.21, 0.21)}) {
    world.bodies.push_back(box("cube", Vec3(0.1, 0.1, 0.1), 1, at));
  }
  GroupOf of(world);
  FoundContacts found(of.group, kClosedGap);
  found.find(of.state, 0);
  ASSERT_EQ(found.features().size(), 4U);
  for (std::size_t c = 0; c < 4; ++c) {
    EXPECT_EQ(found.features()[c].kind == ContactFeature::Kind::kPointOnWall, false);
    EXPECT_NEAR(std::fabs(found.states()[c].normal.x()), 1, 1e-15);
    const ImpactContact impact = found.impactAt(c);
    const Vec3 point = of.state[static_cast<std::size_t>(impact.a)].position + impact.armA;
    EXPECT_NEAR(point.x(), 0.1, 1e-15);
    EXPECT_EQ(impact.normal, found.states()[c].normal);
  }
}

// A contact may open by a sixteenth of a closed gap within a step: at 1 µm/s, in 62.5 ms.
TEST(FoundContacts, obeyTheirLawUnlessTheyOpen) {
  GroupOf of(cubeAbove(0.1, Vec3(0, 0, 1e-6)));
  FoundContacts found(of.group, kClosedGap);
  found.find(of.state, 0);
  ASSERT_EQ(found.features().size(), 4U);
  EXPECT_TRUE(found.obeys(0, 0.0624));
  EXPECT_FALSE(found.obeys(0, 0.0626));
  std::vector<ClosedContact> known(1);
  known[0] = {.feature = found.features()[2], .push = 7, .friction = Vec3(1, 2, 0)};
  known[0].feature.material.friction = 123;  // what is known of it may be old
  const std::vector<ClosedContact> law = found.obeying(0.01, known);
  ASSERT_EQ(law.size(), 4U);
  EXPECT_EQ(law[2].push, 7);
  EXPECT_EQ(law[2].friction, Vec3(1, 2, 0));
  EXPECT_EQ(law[2].feature.material.friction, found.features()[2].material.friction);
  EXPECT_EQ(law[1].push, 0);
  EXPECT_TRUE(found.obeying(1, known).empty());
}

}  // namespace
}  // namespace careen
