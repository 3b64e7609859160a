// Light in pictures from frame to frame, against rays.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <numbers>
#include <optional>
#include <vector>

#include "render/draw/renderer.h"
#include "render/rays.h"

namespace careen {
namespace {

constexpr int kWidthInTime = 240;
constexpr int kHeightInTime = 135;
constexpr int kFrames = 60;
constexpr double kAmbient = 0.3;  // about as looks have it
constexpr double kSun = 0.6;
constexpr double kTurn = 0.1;  // [degrees] a frame

// A box that turns slowly among others, more of them than lists have room for, and sinks a little towards
// them.
Scene heapAround() {
  Scene scene = onOpenFloor(cameraAt(Vec3(2, -4, 3.2), Vec3(0, 0, 0.4), 40));
  for (int i = 0; i < 30; ++i) {
    const double ring = i < 12 ? 0.75 : 1.3;
    SceneBox box = boxAt(Vec3(ring * std::sin(2.4 * i), ring * std::cos(2.4 * i), 0.2 + 0.1 * (i % 3)),
                         Vec3(0.22, 0.18, 0.15), Color{255, 255, 255});
    box.name = "box-" + std::to_string(i);
    box.pose.worldFromBody =
        Quat(1, std::sin(3.0 * i), std::sin(5.0 * i), std::sin(7.0 * i)).normalized().toRotationMatrix();
    scene.boxes.push_back(box);
  }
  scene.boxes.push_back(boxAt(Vec3(0, 0, 0.8), Vec3(0.5, 0.35, 0.12), Color{255, 255, 255}));
  scene.boxes.back().name = "turns";
  return scene;
}

std::vector<Pose> posesAt(const Scene& scene, int frame) {
  std::vector<Pose> poses = posesOf(scene);
  const double angle = frame * kTurn * std::numbers::pi / 180;
  poses.back().worldFromBody =
      (Eigen::AngleAxisd(angle, Vec3::UnitZ()) * Eigen::AngleAxisd(0.2, Vec3::UnitX())).toRotationMatrix();
  poses.back().position.z() -= 0.001 * frame;
  return poses;
}

struct Most {
  int pictures = 0;  // [of 255] change of a pixel between two frames
  int beyond = 0;    // what of it rays do not have
};

template <class PartOf>
Most mostChange(const Scene& scene, const RenderOptions& options, const PartOf& partOf) {
  const RunSetup setup = setupOf(scene, kWidthInTime, kHeightInTime);
  Renderer renderer(setup, options);
  Renderer open(setup, unhindered(options));
  std::optional<Picture> before;
  Most most;
  for (int frame = 0; frame < kFrames; ++frame) {
    const std::vector<Pose> poses = posesAt(scene, frame);
    const Picture now = renderer.draw(poses);
    if (before) {
      const std::vector<Pose> last = posesAt(scene, frame - 1);
      const Rays rays(setup, poses, *scene.camera);
      const Rays raysBefore(setup, last, *scene.camera);
      std::optional<Picture> all;
      for (int y = 2; y + 2 < kHeightInTime; ++y) {
        for (int x = 2; x + 2 < kWidthInTime; ++x) {
          const int change = pixelAt(now, x, y)[1] - pixelAt(*before, x, y)[1];
          if (std::abs(change) <= std::max(2, most.beyond)) {
            continue;  // rays that change the other way would be found where the picture changes more
          }
          const std::optional<Rays::Hit> hit = rays.seenAlone(x, y);
          const std::optional<Rays::Hit> hitBefore = raysBefore.seenAlone(x, y);
          if (!hit || !hitBefore || hit->thing != hitBefore->thing ||
              hit->normal.dot(hitBefore->normal) < 0.999) {
            continue;
          }
          most.pictures = std::max(most.pictures, std::abs(change));
          all = all ? all : open.draw(poses);
          const double light = lightAt(*all, x, y);
          const int expected = srgbFromLinear(light * partOf(rays, x, y, *hit)) -
                               srgbFromLinear(light * partOf(raysBefore, x, y, *hitBefore));
          most.beyond = std::max(most.beyond, std::abs(change - expected));
        }
      }
    }
    before = now;
  }
  return most;
}

// Measured: 1 and 3; at twice the speed, where the light on the box that turns itself changes most, 4.
TEST(LightInTime, changesNoMoreThanThatOfRaysDoes) {
  const Scene scene = heapAround();
  const Vec3 towards = Vec3(-0.5, -0.6, 1).normalized();
  RenderOptions sun = sunlit(towards, 0.03);
  sun.lighting->sky = sun.lighting->ground = Vec3::Constant(kAmbient);
  sun.lighting->light->color = Vec3::Constant(kSun);
  const Most ofLight = mostChange(scene, sun, [&](const Rays& rays, int x, int y, const Rays::Hit& hit) {
    const double sunOpen = kSun * std::max(hit.normal.dot(towards), 0.0);
    return (kAmbient + sunOpen * rays.freePart(x, y, hit, towards, 0.03)) / (kAmbient + sunOpen);
  });
  std::cout << "light changes by " << ofLight.pictures << " of 255, by " << ofLight.beyond
            << " that rays do not have\n";
  EXPECT_GE(ofLight.pictures, 3);
  EXPECT_LE(ofLight.beyond, 3);
  const Most ofOcclusion =
      mostChange(scene, skylit(), [](const Rays& rays, int x, int y, const Rays::Hit& hit) {
        return rays.freePart(x, y, hit, hit.normal, std::nullopt);
      });
  std::cout << "occlusion changes by " << ofOcclusion.pictures << " of 255, by " << ofOcclusion.beyond
            << " that rays do not have\n";
  EXPECT_LE(ofOcclusion.beyond, 3);
}

}  // namespace
}  // namespace careen
