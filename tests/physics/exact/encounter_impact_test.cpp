#include "physics/exact/encounter_impact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/started_bodies.h"

namespace careen {
namespace {

using test::afloat;
using test::cube;
using test::StartedBodies;

// Equal masses, e = 1: they exchange their velocities, by 2 N s in all, face to face.
TEST(EncounterImpact, followsTheLawOfImpact) {
  StartedBodies all(afloat({cube("b", {1, 0, 0}, {-0.5, 0, 0}, {.restitution = 1}),
                            cube("a", {0, 0, 0}, {1.5, 0, 0}, {.restitution = 1})}));
  Encounter encounter = all.encounter(0);
  resolve(all.bodies, encounter);
  EXPECT_NEAR(encounter.bodies[0].after.velocity.x(), -0.5, 1e-15);
  EXPECT_NEAR(encounter.bodies[1].after.velocity.x(), 1.5, 1e-15);
  EXPECT_EQ(encounter.bodies[0].before.velocity.x(), 1.5);
  double impulse = 0;
  for (const ImpactShare& share : encounter.shares) {
    EXPECT_EQ(share.approach, 2);
    impulse += share.impulse;
  }
  EXPECT_NEAR(impulse, 2, 1e-14);

  record(all.bodies, encounter);
  ASSERT_FALSE(all.memory.impacts.empty());
  double recorded = 0;
  for (const Impact& impact : all.memory.impacts) {
    EXPECT_EQ(impact.a.value, 1);  // in the world's order
    EXPECT_EQ(impact.b, Partner::ofBody(0));
    EXPECT_EQ(impact.point.x(), 0.5);
    EXPECT_EQ(impact.normal, Vec3(-1, 0, 0));
    recorded += impact.impulse;
  }
  EXPECT_EQ(recorded, impulse);
  // Rounding of b's place, of 1.5 m/s, and what 2 m/s make of the place.
  const double radius = std::sqrt(3.0) / 2;
  const double speed = 0x1p-52 * (1.5 + 2 * (1 + radius) / radius);
  EXPECT_NEAR(all.bodies[0].doubt.speed, speed, 1e-15 * speed);
  EXPECT_NEAR(all.bodies[1].doubt.speed, speed, 1e-15 * speed);
}

TEST(EncounterImpact, isNotRecordedWhereNothingPushes) {
  StartedBodies all(afloat({cube("a", {0, 0, 0}, {-1, 0, 0}), cube("b", {1, 0, 0}, {1, 0, 0})}));
  Encounter encounter = all.encounter(0);
  resolve(all.bodies, encounter);
  record(all.bodies, encounter);
  EXPECT_FALSE(encounter.contacts.empty());
  EXPECT_TRUE(all.memory.impacts.empty());
}

}  // namespace
}  // namespace careen
