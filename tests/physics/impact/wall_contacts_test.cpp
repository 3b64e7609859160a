#include "physics/impact/wall_contacts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/math/rotation.h"
#include "physics/geometry/separation.h"
#include "physics/world/partner.h"
#include "support/article_equations.h"
#include "support/physics_worlds.h"

namespace careen {
namespace {

struct Found {
  std::vector<ImpactContact> contacts;
  double deepest = 0;
};

// Corners of a box of half sizes 1, 2, 3 that touch a room's walls, x from −5 to 5 and so on.
Found contactsOf(const Vec3& position, const Mat3& worldFromBody = Mat3::Identity()) {
  World world = sampleRoom(makeBox(
      {.halfExtents = {1, 2, 3}, .position = position, .worldFromBody = worldFromBody, .restitution = 0.5}));
  world.walls = roomWalls(Vec3::Constant(-5), Vec3::Constant(5));
  world.walls[4].material = {.restitution = 0.75, .friction = 0.25};
  world.bodies[0].material.friction = 1;
  Found found;
  found.deepest =
      addWallContacts(world, world.bodies[0], world.bodies[0].initial.pose, 7, 20, found.contacts);
  return found;
}

TEST(WallContacts, areNoneInMidAir) {
  const Found found = contactsOf(Vec3(0, 0, -1.99));
  EXPECT_TRUE(found.contacts.empty());
  EXPECT_EQ(found.deepest, 0);
}

// Flat on the floor, wall 4: its four lower corners, with the pair's e = 0.75 and μ = √(1 · 0.25).
TEST(WallContacts, areTheFourCornersOfAFace) {
  const Found found = contactsOf(Vec3(0, 0, -2));
  ASSERT_EQ(found.contacts.size(), 4U);
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(found.contacts[k].b, 24);
    EXPECT_EQ(found.contacts[k].a, 7);
    EXPECT_EQ(found.contacts[k].armA.cwiseAbs(), Vec3(1, 2, 3));
    EXPECT_EQ(found.contacts[k].armA.z(), -3);
    EXPECT_EQ(found.contacts[k].armA, corner(Vec3(1, 2, 3), found.contacts[k].corner));
    EXPECT_EQ(found.contacts[k].normal, Vec3::UnitZ());
    EXPECT_EQ(found.contacts[k].material.restitution, 0.75);
    EXPECT_EQ(found.contacts[k].material.friction, 0.5);
    sum += found.contacts[k].armA;
  }
  EXPECT_EQ(sum, Vec3(0, 0, -12));
  EXPECT_EQ(found.deepest, 0);
}

// In the corner of three walls: four corners of each.
TEST(WallContacts, areThoseOfEveryWallTouched) { EXPECT_EQ(contactsOf(Vec3(4, -3, 2)).contacts.size(), 12U); }

// A quarter turn about x stands the box on its y faces; a tilt of 1e-6 leaves an edge.
TEST(WallContacts, followTheBoxAsItIsTurned) {
  const Mat3 quarter = axisAngle(Vec3::UnitX(), std::acos(0.0));
  EXPECT_EQ(contactsOf(Vec3(0, 0, -3), quarter).contacts.size(), 4U);
  const Mat3 tilted = axisAngle(Vec3::UnitX(), 1e-6);
  const double lowest = 3 * std::cos(1e-6) + 2 * std::sin(1e-6);
  const Found edge = contactsOf(Vec3(0, 0, lowest - 5), tilted);
  ASSERT_EQ(edge.contacts.size(), 2U);
  EXPECT_LT((edge.contacts[0].armA + edge.contacts[1].armA -
             2 * Vec3(0, edge.contacts[0].armA.y(), edge.contacts[0].armA.z()))
                .norm(),
            1e-15);
}

TEST(WallContacts, tellHowDeepTheBoxLies) {
  EXPECT_NEAR(contactsOf(Vec3(0, 0, -2.25)).deepest, 0.25, 1e-15);
  EXPECT_NEAR(contactsOf(Vec3(4.5, 0, -2.25)).deepest, 0.5, 1e-15);
  const double within = kSimultaneous * std::sqrt(14.0);
  EXPECT_EQ(contactsOf(Vec3(0, 0, -2 + 0.9 * within)).contacts.size(), 4U);
  EXPECT_EQ(contactsOf(Vec3(0, 0, -2 + 1.1 * within)).contacts.size(), 0U);
}

}  // namespace
}  // namespace careen
