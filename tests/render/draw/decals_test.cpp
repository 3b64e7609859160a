#include "render/draw/decals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "render/draw/light_plane.h"
#include "view/surfaces.h"

namespace careen {
namespace {

Surface floorOf(double size) {
  Surface floor;
  floor.outline = {Vec3(-size, -size, 0), Vec3(size, -size, 0), Vec3(size, size, 0), Vec3(-size, size, 0)};
  return floor;
}

bool holds(const std::vector<Vec3>& outline, const Vec3& point) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    if ((outline[(i + 1) % outline.size()] - outline[i]).cross(point - outline[i]).z() < -1e-9) {
      return false;
    }
  }
  return outline.size() >= 3;
}

// Whether a ray from a point meets a box, by intervals of its axes, beside the engine.
bool meets(const DrawnBox& box, const Vec3& from, const Vec3& along) {
  double first = 0;
  double last = 1e300;
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis = box.pose.worldFromBody.col(k);
    const double at = axis.dot(from - box.pose.position);
    const double slope = axis.dot(along);
    const double enter = (-std::copysign(box.halfExtents[k], slope) - at) / slope;
    const double leave = (std::copysign(box.halfExtents[k], slope) - at) / slope;
    first = std::max(first, enter);
    last = std::min(last, leave);
  }
  return first < last;
}

class Scenes {
 public:
  double any() { return uniform_(random_); }
  Vec3 vector() { return {any(), any(), any()}; }
  DrawnBox box() {
    DrawnBox box;
    box.halfExtents = Vec3(0.05, 0.05, 0.05) + 0.5 * vector().cwiseAbs();
    box.pose.worldFromBody = Quat(any(), any(), any(), any()).normalized().toRotationMatrix();
    box.pose.position = Vec3(any(), any(), 1 + any());
    return box;
  }
  Vec3 light() { return (Vec3(any(), any(), 0) + Vec3(0, 0, 0.3 + 0.7 * std::abs(any()))).normalized(); }

 private:
  std::mt19937 random_{7};
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

// Light comes from within a cone: where a ray to any part of it meets the box, the outline has the point.
TEST(Decals, shadowOutlinesHoldAllPointsThatTheBoxKeepsLightFrom) {
  Scenes scenes;
  const Surface floor = floorOf(20);
  constexpr double kSpread = 0.03;
  int shaded = 0;
  for (int i = 0; i < 3000; ++i) {
    const DrawnBox box = scenes.box();
    const Vec3 light = scenes.light();
    const std::vector<Vec3> outline = shadowOutline(box, floor, light, kSpread, 0);
    const Vec3 across = light.cross(Vec3::UnitX()).normalized();
    for (int k = 0; k < 20; ++k) {
      const Vec3 below = box.pose.position - box.pose.position.z() / light.z() * light;
      const Vec3 point = below + 2 * Vec3(scenes.any(), scenes.any(), 0);
      const double angle = 3.2 * scenes.any();
      const Vec3 ray = light + kSpread * (std::cos(angle) * across + std::sin(angle) * light.cross(across));
      if (meets(box, point, ray)) {
        ++shaded;
        EXPECT_TRUE(holds(outline, point)) << i << ": " << point.transpose();
      }
    }
  }
  EXPECT_GT(shaded, 3000);
}

// Low light draws penumbrae out along it, but not across.
TEST(Decals, shadowOutlinesOfLowLightAreNarrow) {
  DrawnBox box;
  box.halfExtents = Vec3(0.2, 0.2, 0.2);
  box.pose.position = Vec3(0, 0, 1);
  constexpr double kHeight = 0.06;  // of the light, a sine
  const Vec3 light(std::sqrt(1 - kHeight * kHeight), 0, kHeight);
  double across = 0;
  double along = 0;
  for (const Vec3& corner : shadowOutline(box, floorOf(1000), light, 0.03, 0)) {
    across = std::max(across, std::abs(corner.y()));
    along = std::max(along, -corner.x());
  }
  const double penumbra = 0.03 * 1.2 / kHeight;
  EXPECT_GT(across, 0.2 + penumbra);
  EXPECT_LT(across, 0.2 + 1.2 * penumbra);
  EXPECT_GT(along, 1.2 * light.x() / kHeight + penumbra / kHeight);
}

TEST(Decals, shadowOutlinesEndWithTheSurface) {
  Scenes scenes;
  const Surface floor = floorOf(0.5);
  for (int i = 0; i < 500; ++i) {
    for (const Vec3& corner : shadowOutline(scenes.box(), floor, scenes.light(), 0.03, 0.01)) {
      EXPECT_LT(corner.cwiseAbs().maxCoeff(), 0.5 + 1e-9);
    }
  }
  DrawnBox below = scenes.box();
  below.pose.position.z() = -3;
  EXPECT_TRUE(shadowOutline(below, floor, Vec3::UnitZ(), 0.03, 0).empty());
  EXPECT_TRUE(shadowOutline(scenes.box(), floor, -Vec3::UnitZ(), 0.03, 0).empty());
}

// Along an axis of the box some corners of its outline fall together.
TEST(Decals, lightAlongAnAxisCastsARectangle) {
  DrawnBox box;
  box.halfExtents = Vec3(0.5, 0.3, 0.2);
  box.pose.position = Vec3(0, 0, 1);
  const std::vector<Vec3> outline = shadowOutline(box, floorOf(9), Vec3::UnitZ(), 0, 0);
  ASSERT_EQ(outline.size(), 4U);
  for (const Vec3& corner : outline) {
    EXPECT_LT((corner.cwiseAbs() - Vec3(0.5, 0.3, 0)).norm(), 1e-12);
  }
}

// Outside the outline a box covers less than what is left out, or little more: by random rays.
TEST(Decals, occlusionOutlinesLeaveOutOnlyFaintShade) {
  Scenes scenes;
  const Surface floor = floorOf(50);
  constexpr double kLeast = 0.01;
  double most = 0;
  for (int i = 0; i < 300; ++i) {
    DrawnBox box = scenes.box();
    box.pose.position.z() += 0.9;
    const std::vector<Vec3> outline = occlusionOutline(box, floor, kLeast, 1e9);
    const Vec3 point =
        box.pose.position.cwiseProduct(Vec3(1, 1, 0)) + 3 * Vec3(scenes.any(), scenes.any(), 0);
    if (holds(outline, point)) {
      continue;
    }
    int met = 0;
    constexpr int kRays = 4000;
    for (int k = 0; k < kRays; ++k) {
      const double radius = std::sqrt(0.5 + 0.5 * scenes.any());
      const double angle = 3.14159265358979 * scenes.any();
      const Vec3 ray(radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1 - radius * radius));
      met += meets(box, point, ray) ? 1 : 0;
    }
    most = std::max(most, static_cast<double>(met) / kRays);
  }
  EXPECT_GT(most, 0);
  EXPECT_LT(most, 1.5 * kLeast);
}

TEST(Decals, fansHaveATriangleLessThanTwoCorners) {
  Decals decals;
  decals.addFan(4);
  decals.addFan(3);
  EXPECT_EQ(decals.triangles, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 4, 5, 6}));
  EXPECT_EQ(decals.count, 7U);
}

}  // namespace
}  // namespace careen
