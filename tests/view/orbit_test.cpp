#include "view/orbit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "view/camera.h"

namespace careen {
namespace {

constexpr double kQuarter = std::numbers::pi / 2;

Camera camera(const Vec3& eye) { return {.eye = eye, .target = Vec3(1, 2, 3), .fovDegrees = 33}; }

TEST(Orbit, noneLeavesTheCameraAsItIs) {
  const Camera film = camera({0.1, -7.7, 5.3});
  const Camera same = orbited(film, {});
  EXPECT_EQ(same.eye, film.eye);
  EXPECT_EQ(same.target, film.target);
  EXPECT_EQ(same.fovDegrees, film.fovDegrees);
}

// From the front, 5 m off at the target's height: a quarter by the right-hand rule about +z is its right
// side.
TEST(Orbit, turnsTheEyeAboutTheTarget) {
  const Camera film = camera({1, -3, 3});
  EXPECT_TRUE(orbited(film, {.azimuth = kQuarter}).eye.isApprox(Vec3(6, 2, 3), 1e-12));
  EXPECT_TRUE(
      orbited(film, {.elevation = kQuarter / 3}).eye.isApprox(Vec3(1, 2 - 2.5 * std::sqrt(3), 5.5), 1e-12));
  EXPECT_TRUE(orbited(film, {.distance = 2}).eye.isApprox(Vec3(1, -8, 3), 1e-12));
  EXPECT_EQ(orbited(film, {.azimuth = 1, .distance = 2}).target, film.target);
}

TEST(Orbit, turnsAboutTheCamerasOwnUp) {
  Camera film = camera({1, -3, 3});
  film.up = Vec3::UnitX();
  EXPECT_TRUE(orbited(film, {.azimuth = kQuarter}).eye.isApprox(Vec3(1, 2, -2), 1e-12));
}

TEST(Orbit, neverLooksAlongUp) {
  const Camera film = camera({1, -3, 3});
  for (const double elevation : {-9.0, 9.0}) {
    const Camera turned = orbited(film, {.elevation = elevation});
    EXPECT_NO_THROW(lookAt(turned.eye, turned.target, turned.up));
    EXPECT_NEAR(std::asin((turned.eye - film.target).z() / 5), std::copysign(kSteepest, elevation), 1e-9);
  }
}

// A film that looks down more steeply than that keeps its elevation when it is turned to the side alone.
TEST(Orbit, keepsASteeperFilmsElevation) {
  const Camera film = camera({1, 2 - 0.01, 13});
  const Camera turned = orbited(film, {.azimuth = 1});
  EXPECT_NEAR(turned.eye.z(), 13, 1e-9);
}

TEST(Orbit, turningBackBeginsAtOnce) {
  const Camera film = camera({1, -3, 3});
  Orbit orbit;
  for (int i = 0; i < 100; ++i) {
    orbit = turned(orbit, film, {.elevation = 0.5, .distance = 2});
  }
  EXPECT_NEAR(orbit.elevation, kSteepest, 1e-12);
  EXPECT_EQ(orbit.distance, kFarthest);
  orbit = turned(orbit, film, {.elevation = -0.25, .distance = 0.5});
  EXPECT_NEAR(orbit.elevation, kSteepest - 0.25, 1e-12);
  EXPECT_EQ(orbit.distance, kFarthest / 2);
  for (int i = 0; i < 100; ++i) {
    orbit = turned(orbit, film, {.azimuth = 0.5, .distance = 0.5});
  }
  EXPECT_EQ(orbit.distance, kNearest);
  EXPECT_NEAR(orbit.azimuth, 50, 1e-9);
}

}  // namespace
}  // namespace careen
