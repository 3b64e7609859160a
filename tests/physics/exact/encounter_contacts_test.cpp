#include "physics/exact/encounter_contacts.h"

#include <gtest/gtest.h>

#include "support/started_bodies.h"

namespace careen {
namespace {

using test::afloat;
using test::cube;
using test::held;
using test::onFloor;
using test::StartedBodies;

// A cube on the floor, and one on it that is shifted by half an edge: four corners each, of the upper one's
// face the half that lies on the other.
TEST(EncounterContacts, areCornersOfFacesThatTouch) {
  StartedBodies all(onFloor({cube("a", {0, 0, 0.5}), cube("b", {0.5, 0, 1.5})}));
  const Encounter found = all.encounter(0);
  ASSERT_EQ(found.contacts.size(), 8U);
  for (std::size_t k = 0; k < 8; ++k) {
    const ImpactContact& contact = found.contacts[k];
    if (!found.b(k).mover->isBox()) {
      EXPECT_EQ(contact.armA.cwiseAbs(), Vec3(0.5, 0.5, 0.5));
      EXPECT_EQ(contact.normal, Vec3(0, 0, 1));
    } else {
      EXPECT_EQ(contact.normal, Vec3(0, 0, -1));  // from b to a
      const Vec3 point = found.a(k).before.pose.position + contact.armA;
      EXPECT_TRUE(point.x() == 0 || point.x() == 0.5) << point.x();
      EXPECT_EQ(std::abs(point.y()), 0.5);
      EXPECT_EQ(point.z(), 1);
    }
    EXPECT_EQ(found.persists[k], 0);
  }
}

TEST(EncounterContacts, tellHowDeepACornerIsInAWall) {
  StartedBodies all(onFloor({cube("a", {0, 0, 0.5 - 0x1p-40})}));
  Encounter found = gather(all.bodies, {.time = Instant(0), .kind = EventKind::kContact, .body = 0});
  EXPECT_EQ(findContacts(all.bodies, found), 0x1p-40);
}

TEST(EncounterContacts, areNoneOfHeldBodies) {
  StartedBodies all(afloat({held(cube("a", {0, 0, 0})), cube("b", {1, 0, 0}), held(cube("c", {0.5, 1, 0}))}));
  const Encounter found = all.encounter(1);
  ASSERT_EQ(found.ranks().size(), 3U);
  for (std::size_t k = 0; k < found.contacts.size(); ++k) {
    EXPECT_TRUE(found.indexA(k) == 1 || found.indexB(k) == 1);
  }
}

// Two cubes at a common edge: either of two axes keeps them apart. Once they approach along one of them, the
// other does; the contact that had both is met anew.
TEST(EncounterContacts, haveNoChoiceOfAxesThatAreApproached) {
  StartedBodies all(afloat({cube("a", {0, 0, 0}), cube("b", {1, 0, 1})}));
  Encounter found = all.encounter(0);
  ASSERT_FALSE(found.contacts.empty());
  const std::size_t both = found.contacts[0].directions.size();
  ASSERT_GE(both, 2U);
  found.persists.assign(found.contacts.size(), 1);
  Encounter still = found;
  choose(all.bodies, still, 0, Vec3::Zero());
  EXPECT_EQ(still.contacts[0].directions.size(), both);
  EXPECT_EQ(still.persists[0], 1);
  choose(all.bodies, found, 0, {1, 0, -1});  // towards b along x, and away along z
  EXPECT_TRUE(found.contacts[0].directions.empty());
  EXPECT_EQ(found.persists[0], 0);
}

}  // namespace
}  // namespace careen
