#include "view/screen.h"

#include <gtest/gtest.h>

#include "support/stages.h"

namespace careen {
namespace {

// From 10 m in front of the origin, 90° upward: at the origin half of 720 rows is 10 m.
Screen straight() {
  const Camera camera = cameraAt(Vec3(0, -10, 0), Vec3::Zero(), 90);
  return {viewOf(camera, {.min = Vec3(-5, -5, -5), .max = Vec3(5, 5, 5)}, 16.0 / 9), 1280, 720};
}

TEST(Screen, agreesWithTheViewAndWithSimilarTriangles) {
  const Screen screen = straight();
  const Vec2 at = screen.at(Vec3(2, -5, 1)).value();  // 5 m away: 72 px to the metre
  EXPECT_NEAR(at.x(), 640 + 144, 1e-9);
  EXPECT_NEAR(at.y(), 360 - 72, 1e-9);
  EXPECT_NEAR(screen.metresPerPixel(Vec3(3, -5, 2)), 1 / 72.0, 1e-12);
  EXPECT_NEAR(screen.depth(Vec3(3, -5, 2)), 5, 1e-12);
}

// 72 px are a metre at 5 m: a tenth of that per metre of depth, and 0.2 there.
TEST(Screen, rayLeadsToWhatIsSeen) {
  const Screen screen = straight();
  EXPECT_LT((screen.ray(Vec2(640 + 72, 360 - 144)) - Vec3(0.2, 1, 0.4)).norm(), 1e-12);
  const Camera aslant = cameraAt(Vec3(3, -7, 5), Vec3(0, 1, 1), 40);
  const Screen other(viewOf(aslant, {.min = Vec3(-5, -5, -5), .max = Vec3(5, 5, 5)}, 16.0 / 9), 1280, 720);
  const Vec3 point(0.4, -0.7, 2);
  const Vec3 found = other.eye() + other.depth(point) * other.ray(other.at(point).value());
  EXPECT_LT((found - point).norm(), 1e-12);
}

TEST(Screen, whatIsBehindTheCameraHasNoPlace) {
  const Screen screen = straight();
  EXPECT_FALSE(screen.at(Vec3(0, -11, 0)));
  EXPECT_FALSE(screen.at(Vec3(0, -10, 0)));
  EXPECT_FALSE(screen.line(Vec3(1, -11, 0), Vec3(0, -12, 3)));
}

// A line along x = 1, z = 1 runs outward from the picture's middle for ever as it nears the eye.
TEST(Screen, lineEndsAtTheCamera) {
  const Screen screen = straight();
  for (const bool turned : {false, true}) {
    const Vec3 ahead(1, 0, 1);
    const Vec3 behind(1, -20, 1);
    const auto line = turned ? screen.line(behind, ahead) : screen.line(ahead, behind);
    ASSERT_TRUE(line);
    const Vec2 far = turned ? line->second : line->first;
    const Vec2 near = turned ? line->first : line->second;
    EXPECT_NEAR((far - screen.at(ahead).value()).norm(), 0, 1e-9);
    EXPECT_GT(near.x(), 3000);
    EXPECT_LT(near.y(), -2000);
  }
}

}  // namespace
}  // namespace careen
