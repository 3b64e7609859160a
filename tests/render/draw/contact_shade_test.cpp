#include "render/draw/contact_shade.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "render/stage.h"
#include "support/article_equations.h"

namespace careen {
namespace {

std::vector<Surface> floorOf(const Scene& scene) {
  std::vector<Surface> floor;
  for (const Surface& surface : surfacesOf(stageOf(scene), extentOf(setupOf(scene)))) {
    if (surface.normal.z() > 0.99) {
      floor.push_back(surface);
    }
  }
  return floor;
}

DrawnBox plate(const Vec3& position) {
  DrawnBox box;
  box.pose.position = position;
  box.halfExtents = Vec3(0.4, 0.2, 0.1);
  return box;
}

TEST(ContactShade, liesUnderTheBoxAndTurnsWithIt) {
  const std::vector<Surface> floor = floorOf(crateInRoom());
  ASSERT_EQ(floor.size(), 1U);
  DrawnBox box = plate(Vec3(0.5, 0.3, 0.1));
  box.pose.worldFromBody = axisAngle(Vec3::UnitZ(), 0.4);
  const std::vector<ContactShade> shades = contactShades({&box, 1}, floor, 0.7);
  ASSERT_EQ(shades.size(), 1U);
  EXPECT_NEAR(shades[0].centre.x(), 0.5, 1e-12);
  EXPECT_NEAR(shades[0].centre.y(), 0.3, 1e-12);
  EXPECT_NEAR(shades[0].strength, 0.7, 1e-12);
  const Vec3 longest = shades[0].first.norm() > shades[0].second.norm() ? shades[0].first : shades[0].second;
  EXPECT_NEAR(std::fabs(longest.normalized().dot(Vec3(std::cos(0.4), std::sin(0.4), 0))), 1, 1e-12);
  EXPECT_NEAR(shades[0].first.dot(shades[0].second), 0, 1e-12);
}

TEST(ContactShade, fadesAndWidensAsTheBoxRises) {
  const std::vector<Surface> floor = floorOf(crateInRoom());
  double strength = 1;
  double width = 0;
  for (const double height : {0.1, 0.12, 0.15, 0.2}) {
    const DrawnBox box = plate(Vec3(0, 0, height));
    const std::vector<ContactShade> shades = contactShades({&box, 1}, floor, 0.7);
    ASSERT_EQ(shades.size(), 1U);
    EXPECT_LT(shades[0].strength, strength);
    EXPECT_GT(shades[0].first.norm(), width);
    strength = shades[0].strength;
    width = shades[0].first.norm();
  }
  const DrawnBox high = plate(Vec3(0, 0, 1));
  EXPECT_TRUE(contactShades({&high, 1}, floor, 0.7).empty());
}

TEST(ContactShade, isNotBesideTheSurfaceNorBehindItNorUnderSprings) {
  const std::vector<Surface> floor = floorOf(crateInRoom());  // from -3 to 3, -2 to 2
  const DrawnBox beside = plate(Vec3(4, 0, 0.1));
  const DrawnBox below = plate(Vec3(0, 0, -0.1));
  DrawnBox spring = plate(Vec3(0, 0, 0.1));
  spring.marked = false;
  for (const DrawnBox& box : {beside, below, spring}) {
    EXPECT_TRUE(contactShades({&box, 1}, floor, 0.7).empty());
  }
}

}  // namespace
}  // namespace careen
