#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
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

// Pixels of a box whose front and top a copy of an earlier moment shares, that are not as if it were there
// alone.
int fought(const Lighting& lighting, bool withCaster) {
  Scene scene = onOpenFloor(cameraAt(Vec3(0, -4, 3), Vec3(0, 0, 0.5), 40));
  scene.boxes.push_back(boxAt(Vec3(0, 0, 0.5), Vec3(0.5, 0.5, 0.5), Color{255, 255, 255}));
  if (withCaster) {
    scene.boxes.push_back(boxAt(Vec3(-0.2, 0.3, 1.7), Vec3(0.3, 0.1, 0.1), Color{255, 255, 255}));
    scene.boxes.back().name = "caster";
  }
  RenderOptions options = lit(lighting);
  Renderer renderer(setupOf(scene, kWidthOfShot, kHeightOfShot), options);
  const std::vector<Pose> late = posesOf(scene);
  const auto moved = [&](const Vec3& by) {
    std::vector<Pose> poses = late;
    poses[0].position += by;
    return poses;
  };
  std::vector<Pose> both = moved(Vec3(-0.31, 0, 0));
  both.insert(both.end(), late.begin(), late.end());
  const Picture alone = renderer.draw(late);
  const Picture without = renderer.draw(moved(Vec3(0, 90, 0)));
  const Picture strobe = renderer.draw(both);
  int seen = 0;
  int other = 0;
  for (int y = 0; y < kHeightOfShot; ++y) {
    for (int x = 0; x < kWidthOfShot; ++x) {
      // What the box shades is not the box: it is where its height says.
      const bool isBox =
          pixelAt(alone, x, y) != pixelAt(without, x, y) && x > 67 && x < 92 && y > 33 && y < 58;
      seen += isBox ? 1 : 0;
      other += isBox && pixelAt(strobe, x, y) != pixelAt(alone, x, y) ? 1 : 0;
    }
  }
  EXPECT_GT(seen, 400);
  return other;
}

TEST(RendererShot, ofCopiesInOnePlaneTheLatestIsSeen) {
  EXPECT_EQ(fought(evenLighting(), false), 0);
  EXPECT_EQ(fought(lightingOf(Look::kStudio, cameraAt(Vec3(0, -4, 3), Vec3(0, 0, 0.5), 40)), true), 0);
}

// A tall block whose side is a third of a pixel wide: its outline is as straight as that of many samples a
// pixel. A face that is there in some rows only makes it a row of dashes.
TEST(RendererShot, facesThinnerThanAPixelLeaveTheOutlineStraight) {
  Scene scene;
  scene.boxes.push_back(boxAt(Vec3(0, 0, 0), Vec3(0.25, 0.25, 1.4), Color{40, 40, 40}));
  scene.boxes[0].pose.worldFromBody =
      (Eigen::AngleAxisd(0.06, Vec3::UnitY()) * Eigen::AngleAxisd(-0.05, Vec3::UnitZ())).toRotationMatrix();
  scene.camera = cameraAt(Vec3(0, -8, 0), Vec3::Zero(), 30);
  const auto drawn = [&](Antialiasing antialiasing) {
    scene.picture.antialiasing = antialiasing;
    return drawnShot(scene, lit(evenLighting(Vec3::Ones())));
  };
  const Picture edges = drawn(Antialiasing::kEdges);
  const Picture exact = drawn(Antialiasing::kSupersampled);
  double worst = 0;
  for (int y = 20; y < kHeightOfShot - 20; ++y) {
    for (const bool left : {true, false}) {
      const auto light = [&](const Picture& picture) {
        double sum = 0;
        for (int x = left ? 0 : kWidthOfShot / 2; x < (left ? kWidthOfShot / 2 : kWidthOfShot); ++x) {
          sum += lightAt(picture, x, y);
        }
        return sum;
      };
      worst = std::max(worst, std::fabs(light(edges) - light(exact)));
    }
  }
  std::cout << "outline off by " << worst << " px at most\n";
  EXPECT_LT(worst, 0.3);  // measured 0.22; 0.58 where each face ends at its own edges
}

}  // namespace
}  // namespace careen
