#include "view/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/math/rotation.h"
#include "support/stages.h"

namespace careen {
namespace {

constexpr double kWideAspect = 16.0 / 9;

// Looks along +y from 10 m away with a vertical field of 90°: half the picture's height is 10 m there.
View straightView() {
  const Camera camera = cameraAt(Vec3(1, -10, 2), Vec3(1, 0, 2), 90);
  return viewOf(camera, {.min = Vec3(-5, -5, -5), .max = Vec3(5, 5, 5)}, kWideAspect);
}

TEST(Camera, targetIsInTheMiddleOfThePicture) {
  const Vec3 pixel = straightView().pixelFromWorld(Vec3(1, 0, 2), 1280, 720);
  EXPECT_NEAR(pixel.x(), 640, 1e-10);
  EXPECT_NEAR(pixel.y(), 360, 1e-10);
}

TEST(Camera, rightIsRightAndUpIsUpByThePicturesScale) {
  const Vec3 pixel = straightView().pixelFromWorld(Vec3(6, 0, 7), 1280, 720);  // 5 m right, 5 m up
  EXPECT_NEAR(pixel.x(), 640 + 180, 1e-10);
  EXPECT_NEAR(pixel.y(), 360 - 180, 1e-10);
}

TEST(Camera, depthGrowsAwayFromTheEyeFromMinusOneToOne) {
  const View view = straightView();
  double last = -1;
  for (const double y : {-9.0, -5.0, 0.0, 50.0, 500.0}) {
    const double depth = view.pixelFromWorld(Vec3(1, y, 2), 1280, 720).z();
    EXPECT_GT(depth, last) << y;
    last = depth;
  }
  EXPECT_LT(last, 1);
}

// By similar triangles: a point twice as far as what is sharp moves by half of what the eye does, as seen
// there, along with it; one half as far moves as much, against it.
TEST(Camera, fromBesideWhatIsSharpStaysWhereItIs) {
  Camera camera = cameraAt(Vec3(1, -10, 2), Vec3(1, 0, 2), 90);
  camera.beside = Vec2(0.5, 0.25);
  camera.sharpAt = 10;
  const View view = viewOf(camera, {.min = Vec3(-5, -5, -5), .max = Vec3(5, 5, 5)}, kWideAspect);
  EXPECT_EQ(view.eye, Vec3(1.5, -10, 2.25));
  const Vec3 sharp = view.pixelFromWorld(Vec3(6, 0, 7), 1280, 720);
  EXPECT_NEAR(sharp.x(), 640 + 180, 1e-10);
  EXPECT_NEAR(sharp.y(), 360 - 180, 1e-10);
  const Vec3 far = view.pixelFromWorld(Vec3(1, 10, 2), 1280, 720);  // 36 px for each of its metres at sharpAt
  EXPECT_NEAR(far.x(), 640 + 0.25 * 36, 1e-10);
  EXPECT_NEAR(far.y(), 360 - 0.125 * 36, 1e-10);
  const Vec3 near = view.pixelFromWorld(Vec3(1, -5, 2), 1280, 720);
  EXPECT_NEAR(near.x(), 640 - 0.5 * 36, 1e-10);
}

TEST(Camera, orientationIsSpecialOrthogonal) {
  const Mat3 a = lookAt(Vec3(3, -4, 2), Vec3(0.5, 1, -1), Vec3(0.2, 0.1, 1));
  EXPECT_LT(orthogonalityError(a), 1e-15);
  EXPECT_NEAR(a.determinant(), 1, 1e-15);
  EXPECT_LT((a * Vec3(0, 0, -1) - (Vec3(0.5, 1, -1) - Vec3(3, -4, 2)).normalized()).norm(), 1e-15);
}

TEST(Camera, refusesToLookNowhereOrAlongItsUp) {
  EXPECT_THROW(lookAt(Vec3(1, 2, 3), Vec3(1, 2, 3), Vec3::UnitZ()), InputError);
  EXPECT_THROW(lookAt(Vec3(0, 0, 5), Vec3::Zero(), Vec3::UnitZ()), InputError);
}

// Every corner within the picture, and one of them near its edge: neither cut off nor lost in the distance.
TEST(Camera, defaultSeesTheWholeSceneAndNotMuchMore) {
  for (const Vec3& size : {Vec3(6, 4, 3), Vec3(1, 1, 9), Vec3(0.01, 0.02, 0.01), Vec3(500, 10, 10)}) {
    for (const double aspect : {kWideAspect, 0.5}) {
      const Extent extent{.min = Vec3(7, -3, 2), .max = Vec3(7, -3, 2) + size};
      const View view = viewOf(cameraThatSees(extent, aspect), extent, aspect);
      double farthestOut = 0;
      for (int corner = 0; corner < 8; ++corner) {
        const Vec3 pixel = view.pixelFromWorld(extent.corner(corner), 2, 2) - Vec3(1, 1, 0);
        farthestOut = std::max(farthestOut, std::max(std::abs(pixel.x()), std::abs(pixel.y())));
        EXPECT_LT(std::abs(pixel.z()), 1);
      }
      EXPECT_LT(farthestOut, 1);
      EXPECT_GT(farthestOut, 0.9);
    }
  }
}

TEST(Camera, ofTheSceneComesFirst) {
  Scene scene = crateInRoom();
  EXPECT_EQ(cameraOf(setupOf(scene), kWideAspect).eye, Vec3(-1.5, -7, 3));
  scene.camera.reset();
  EXPECT_EQ(cameraOf(setupOf(scene), kWideAspect).target, Vec3(0, 0, 1.5));
}

}  // namespace
}  // namespace careen
