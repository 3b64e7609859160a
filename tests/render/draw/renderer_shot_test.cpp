#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "render/draw/renderer.h"
#include "render/rays.h"
#include "render/stage.h"

namespace careen {
namespace {

constexpr int kWidthOfShot = 160;
constexpr int kHeightOfShot = 90;

Picture drawnShot(const Scene& scene, const RenderOptions& options = {}) {
  return Renderer(setupOf(scene, kWidthOfShot, kHeightOfShot), options).draw(posesOf(scene));
}

RenderOptions litFrom(const Camera& camera) {
  RenderOptions options;
  options.lighting = lightingOf(Look::kStudio, camera);
  return options;
}

TEST(RendererShot, sameShotGivesTheSameBytesWhateverWasSeenBefore) {
  const Scene scene = crateInRoom();
  const std::vector<Pose> poses = posesOf(scene);
  const Camera elsewhere = cameraAt(Vec3(2, -6, 2), Vec3(0.5, 0, 1), 50);
  Renderer renderer(setupOf(scene, kWidthOfShot, kHeightOfShot));
  const Picture first = renderer.draw(poses);
  const Picture other = renderer.draw({.poses = poses, .camera = elsewhere});
  EXPECT_NE(other.rgb, first.rgb);
  EXPECT_EQ(renderer.draw(poses).rgb, first.rgb);
  EXPECT_EQ(renderer.draw({.poses = poses, .camera = *scene.camera}).rgb, first.rgb);
  // Floor and walls move with the eye: a scene that has its camera there looks the same.
  Scene there = scene;
  there.camera = elsewhere;
  EXPECT_EQ(drawnShot(there, litFrom(*scene.camera)).rgb, other.rgb);
}

TEST(RendererShot, lightStaysWhereTheFirstCameraPutsIt) {
  Scene scene = crateInRoom();
  RenderOptions options;
  options.camera = cameraAt(Vec3(4, -6, 2), Vec3(0, 0, 1), 50);
  EXPECT_EQ(Renderer(setupOf(scene, kWidthOfShot, kHeightOfShot), options)
                .draw({.poses = posesOf(scene), .camera = *scene.camera})
                .rgb,
            drawnShot(scene, litFrom(*options.camera)).rgb);
  EXPECT_NE(drawnShot(scene).rgb, drawnShot(scene, litFrom(*options.camera)).rgb);
}

// Light that reaches the floor between two boxes, with a third farther away.
class Copies : public testing::Test {
 protected:
  Copies() {
    for (const Vec3& position : {Vec3(-0.7, 0, 0.5), Vec3(0.7, 0, 0.5), Vec3(0, 9, 4)}) {
      add(scene_, position);
    }
  }
  static void add(Scene& scene, const Vec3& position) {
    scene.boxes.push_back(boxAt(position, Vec3(0.5, 0.5, 0.5), Color{255, 255, 255}));
    scene.boxes.back().name = "box-" + std::to_string(scene.boxes.size());
  }
  static double between(const Scene& scene, const std::vector<Pose>& poses) {
    return lightAt(Renderer(setupOf(scene, kWidthOfShot, kHeightOfShot), skylit()).draw(poses),
                   kWidthOfShot / 2, kHeightOfShot / 2);
  }
  // With these boxes moved so far from moment to moment.
  double strobe(const std::vector<std::size_t>& moving, const Vec3& step, int moments) const {
    std::vector<Pose> poses;
    for (int moment = 0; moment < moments; ++moment) {
      std::vector<Pose> now = posesOf(scene_);
      for (const std::size_t body : moving) {
        now[body].position += moment * step;
      }
      poses.insert(poses.end(), now.begin(), now.end());
    }
    return between(scene_, poses);
  }

  Scene scene_ = onOpenFloor(cameraAt(Vec3(0, -6, 6), Vec3::Zero(), 40));
};

TEST_F(Copies, inOnePlaceOccludeTheFloorAsOneBox) {
  const double still = between(scene_, posesOf(scene_));
  EXPECT_NEAR(strobe({2}, Vec3(0.5, 0, 0), 2), still, 0.01);  // beside them the others are what they are
  for (const int moments : {2, 5, 20}) {
    EXPECT_NEAR(strobe({0, 1}, Vec3(0, 0, 0.02 / moments), moments), still, 0.02) << moments;
  }
}

TEST_F(Copies, occludeTheFloorAsSoManyBoxesAtMost) {
  const double still = between(scene_, posesOf(scene_));
  for (const double step : {0.2, 0.5, 1.2, 3.0}) {
    Scene many = scene_;
    for (int moment = 1; moment < 5; ++moment) {
      add(many, scene_.boxes[0].pose.position - Vec3(moment * step, 0, 0));
    }
    const double copies = strobe({0}, Vec3(-step, 0, 0), 5);
    EXPECT_GT(copies, between(many, posesOf(many)) - 0.01) << step;
    EXPECT_GT(copies, 0.8 * still) << step;
    EXPECT_LT(copies, 1.2 * still) << step;
  }
}

}  // namespace
}  // namespace careen
