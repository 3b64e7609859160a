#include "physics/geometry/chosen_contact.h"

#include <gtest/gtest.h>

namespace careen {
namespace {

constexpr double kWithin = 1e-9;
constexpr double kSlow = 1e-12;

// A cube whose edge is at that of another, level with its top.
ChosenContact contactMoving(const Vec3& velocity, double depth = 0) {
  static const Vec3 half(0.5, 0.5, 0.5);
  static const Pose b;
  const Pose a{.position = Vec3(-1, 0.25, 1 - depth)};
  return chosenContact({a, half}, {b, half}, 0, kWithin, kSlow,
                       [&](const Vec3&, const Vec3&) { return velocity; });
}

TEST(ChosenContact, whatSlidesOntoTheOtherIsOnItsTop) {
  for (const double depth : {0.0, 1e-11}) {
    const ChosenContact contact = contactMoving({1, 0, 0}, depth);
    ASSERT_EQ(contact.points.size(), 2U) << depth;
    EXPECT_EQ(contact.points[0].normal, Vec3(Vec3::UnitZ())) << depth;
    EXPECT_NE(contact.choice, 0U) << depth;
  }
}

TEST(ChosenContact, whatFallsBesideTheOtherIsAtItsSide) {
  EXPECT_EQ(contactMoving({0, 0, -1}).points[0].normal, Vec3(-Vec3::UnitX()));
}

TEST(ChosenContact, whatStandsOrStrikesTheEdgeHasTheMiddle) {
  const Vec3 middle = Vec3(-1, 0, 1).normalized();
  for (const Vec3& velocity : {Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(1, 0, -1)}) {
    EXPECT_NEAR((contactMoving(velocity).points[0].normal - middle).norm(), 0, 1e-15) << velocity;
  }
}

TEST(ChosenContact, deepBoxesHaveNothingToChoose) { EXPECT_EQ(contactMoving({1, 0, 0}, 1e-6).choice, 0U); }

}  // namespace
}  // namespace careen
