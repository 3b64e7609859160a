#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "render/overlay/overlays.h"
#include "render/stage.h"
#include "scene/plan.h"
#include "view/scene_extent.h"

namespace careen {

inline constexpr int kWidth = 1280;
inline constexpr int kHeight = 720;
inline constexpr double kFrame = 1.0 / 30;

// The crate's room seen straight on from 10 m in front of y = 0, 60° upward.
inline Scene roomStraightOn() {
  Scene scene = crateInRoom();
  scene.camera = cameraAt(Vec3(0, -10, 1.5), Vec3(0, 0, 1.5), 60);
  return scene;
}
inline const double kPixels = 360 / std::tan(std::numbers::pi / 6) / 10;  // to the metre at y = 0

inline Vec2 onPicture(const Vec3& point) {
  const double scale = kPixels * 10 / (point.y() + 10);
  return {640 + scale * point.x(), 360 - scale * (point.z() - 1.5)};
}

inline bool overlap(const Plate& a, const Plate& b) {
  return (a.min.array() < b.max.array()).all() && (b.min.array() < a.max.array()).all();
}

// The shapes of one kind.
template <class Shape>
std::vector<Shape> only(const OverlayShapes& shapes) {
  std::vector<Shape> found;
  for (const OverlayShape& each : shapes) {
    if (const Shape* const shape = std::get_if<Shape>(&each)) {
      found.push_back(*shape);
    }
  }
  return found;
}

class OverlayPictures : public testing::Test {
 protected:
  OverlayShapes shapesAt(const std::string& names, double time, int width = kWidth,
                         int height = kHeight) const {
    const Trajectory run = shown();
    Overlays overlays(run, OverlaySet::named(names), kFrame);
    const double aspect = static_cast<double>(width) / height;
    const View view = viewOf(*scene_.camera, extentOf(run), aspect);
    const auto momentAt = [&](double filmTime) {
      return OverlayMoment{.sceneTime = std::clamp(filmTime, 0.0, run.settings.duration), .view = view};
    };
    return overlays.shapesAt(time, momentAt, width, height);
  }
  // Arrows of one overlay; the legend's, which come last, are not among them.
  std::vector<Stroke> arrows(const std::string& name, double time) const {
    std::vector<Stroke> found = only<Stroke>(shapesAt(name, time));
    found.pop_back();
    return found;
  }
  // The run with the scene's boxes as they are now.
  Trajectory shown() const {
    Trajectory run = shownAs(scene_, run_);
    run.world = setupOf(scene_).world;
    return run;
  }
  void simulate() { run_ = runOf(scene_); }
  void fall() {
    scene_.gravity = Vec3(0, 0, -10);
    scene_.room->material.restitution = 0.5;
    scene_.boxes[0] = boxAt(Vec3(0, 0, 1), Vec3(0.3, 0.3, 0.2));
    simulate();
  }
  void strike(double time, double impulse) {
    run_.impacts.push_back({.time = time,
                            .a = {0},
                            .b = Partner::ofWall(0),
                            .point = Vec3(1, 0, 1),
                            .normal = Vec3(-1, 0, 0),
                            .impulse = impulse});
  }

  Scene scene_ = roomStraightOn();
  Trajectory run_ = drifting(scene_, Vec3(1, 0, 0.5));
};

inline void expectNear(const Vec2& found, const Vec2& expected, double tolerance = 1e-6) {
  EXPECT_LT((found - expected).norm(), tolerance) << found.transpose() << "; " << expected.transpose();
}

}  // namespace careen
