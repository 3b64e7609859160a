#include <gtest/gtest.h>

#include "physics/search/time_of_impact.h"
#include "support/gap_oracle.h"

namespace careen {
namespace {

using test::Dice;
using test::Meeting;
using test::meeting;
using test::MirroredBox;
using test::roomFlight;
using test::TumblingBox;

// Lengths × 4 with times × 2: gravity stays, and every number is multiplied by a power of two.
TumblingBox magnified(TumblingBox box) {
  box.halfExtents *= 4;
  box.position *= 4;
  box.velocity *= 2;
  box.precession /= 2;
  box.spin /= 2;
  return box;
}

const Vec3 kSlope = Vec3(0.3, 0.2, 0.9).normalized();

TEST(TimeOfImpactSymmetry, lengthsTimes4AndTimesTimes2AreTheSameBitsAtAWall) {
  Dice dice(11);
  for (int k = 0; k < 2000; ++k) {
    const TumblingBox box = roomFlight(dice, k);
    const TumblingBox large = magnified(box);
    const FirstContact hit = firstContactWithWall(box.moving(), kSlope, -2.8, {.from = 0, .until = 4});
    const FirstContact same = firstContactWithWall(large.moving(), kSlope, -11.2, {.from = 0, .until = 8});
    ASSERT_EQ(same.kind, hit.kind);
    ASSERT_EQ(same.time, 2 * hit.time);
    ASSERT_EQ(same.approach, 2 * hit.approach);
    ASSERT_EQ(same.evaluations, hit.evaluations);
  }
}

TEST(TimeOfImpactSymmetry, lengthsTimes4AndTimesTimes2AreTheSameBitsForTwoBoxes) {
  Dice dice(12);
  for (int k = 0; k < 2000; ++k) {
    const Meeting pair = meeting(dice, k);
    const TumblingBox a = magnified(pair.a);
    const TumblingBox b = magnified(pair.b);
    const FirstContact hit = firstContactOfBoxes(pair.a.moving(), pair.b.moving(), {.from = 0, .until = 2});
    const FirstContact same = firstContactOfBoxes(a.moving(), b.moving(), {.from = 0, .until = 4});
    ASSERT_EQ(same.kind, hit.kind);
    ASSERT_EQ(same.time, 2 * hit.time);
    ASSERT_EQ(same.approach, 2 * hit.approach);
    ASSERT_EQ(same.evaluations, hit.evaluations);
  }
}

TEST(TimeOfImpactSymmetry, theMirrorImageIsTheSameBits) {
  Dice dice(13);
  const Vec3 mirror(-1, 1, 1);
  for (int k = 0; k < 2000; ++k) {
    const TumblingBox box = roomFlight(dice, k);
    const MirroredBox image{box};
    const FirstContact wall = firstContactWithWall(box.moving(), kSlope, -2.8, {.from = 0, .until = 4});
    const FirstContact imageOfWall =
        firstContactWithWall(image.moving(), mirror.cwiseProduct(kSlope), -2.8, {.from = 0, .until = 4});
    ASSERT_EQ(imageOfWall.time, wall.time);
    ASSERT_EQ(imageOfWall.approach, wall.approach);

    const Meeting pair = meeting(dice, k);
    const MirroredBox imageA{pair.a};
    const MirroredBox imageB{pair.b};
    const FirstContact hit = firstContactOfBoxes(pair.a.moving(), pair.b.moving(), {.from = 0, .until = 2});
    const FirstContact imageOfHit =
        firstContactOfBoxes(imageA.moving(), imageB.moving(), {.from = 0, .until = 2});
    ASSERT_EQ(imageOfHit.time, hit.time);
    ASSERT_EQ(imageOfHit.approach, hit.approach);
    ASSERT_EQ(imageOfHit.normal, mirror.cwiseProduct(hit.normal));
  }
}

TEST(TimeOfImpactSymmetry, boxesInTheOtherOrderGiveTheSameBits) {
  Dice dice(14);
  for (int k = 0; k < 2000; ++k) {
    const Meeting pair = meeting(dice, k);
    const FirstContact hit = firstContactOfBoxes(pair.a.moving(), pair.b.moving(), {.from = 0, .until = 2});
    const FirstContact other = firstContactOfBoxes(pair.b.moving(), pair.a.moving(), {.from = 0, .until = 2});
    ASSERT_EQ(other.kind, hit.kind);
    ASSERT_EQ(other.time, hit.time);
    ASSERT_EQ(other.approach, hit.approach);
    ASSERT_EQ(other.evaluations, hit.evaluations);
    ASSERT_EQ(other.normal, Vec3(-hit.normal));
  }
}

// Two cubes face to face: many directions separate equally, none is preferred for standing first.
TEST(TimeOfImpactSymmetry, equalDirectionsDoNotMakeTheOrderMatter) {
  TumblingBox a{.halfExtents = Vec3(0.5, 0.5, 0.5), .velocity = Vec3(1, 0, 0), .precession = 3};
  TumblingBox b{.halfExtents = Vec3(0.5, 0.5, 0.5), .position = Vec3(2.5, 0.25, 0), .precession = -3};
  const FirstContact hit = firstContactOfBoxes(a.moving(), b.moving(), {.from = 0, .until = 2});
  const FirstContact other = firstContactOfBoxes(b.moving(), a.moving(), {.from = 0, .until = 2});
  ASSERT_EQ(hit.kind, ContactKind::kImpact);
  EXPECT_EQ(other.time, hit.time);
  EXPECT_EQ(other.evaluations, hit.evaluations);
}

// The clock's zero may be anywhere: only ages enter.
TEST(TimeOfImpactSymmetry, anOlderFlightIsTheSameFlight) {
  Dice dice(15);
  for (int k = 0; k < 200; ++k) {
    const Meeting pair = meeting(dice, k);
    const FirstContact hit = firstContactOfBoxes(pair.a.moving(), pair.b.moving(), {.from = 0, .until = 2});
    if (hit.kind != ContactKind::kImpact || hit.approach < 0.5) {
      continue;
    }
    MovingBox a = pair.a.moving();
    MovingBox b = pair.b.moving();
    a.age = b.age = 0.5 * hit.time;
    const FirstContact later = firstContactOfBoxes(a, b, {.from = 0, .until = 2});
    // Measured 4e-16.
    EXPECT_NEAR(later.time + a.age, hit.time, 4e-15);
  }
}

}  // namespace
}  // namespace careen
