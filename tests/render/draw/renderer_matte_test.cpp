#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "image/matte.h"
#include "render/draw/renderer.h"
#include "render/stage.h"

namespace careen {
namespace {

constexpr int kWide = 320;
constexpr int kHigh = 180;

// By the rule for pictures with alpha, as image programs do it.
double over(const Picture& picture, std::size_t sample, double below) {
  const double alpha = picture.alpha[sample / 3] / 255.0;
  return alpha * picture.rgb[sample] + (1 - alpha) * below;
}

struct Taken {
  MatteParts parts;
  Picture onNothing;
  Picture whole;
};

Taken takenFrom(const Scene& scene, Antialiasing antialiasing = Antialiasing::kEdges) {
  Scene shown = scene;
  shown.picture.antialiasing = antialiasing;
  Renderer renderer(setupOf(shown, kWide, kHigh));
  const std::vector<Pose> poses = posesOf(shown);
  const Shot shot{.poses = poses, .camera = *shown.camera};
  Taken taken{.parts = renderer.drawMatte(shot), .onNothing = {}, .whole = renderer.draw(shot)};
  taken.onNothing = onNothing(taken.parts);
  return taken;
}

bool isEdge(const MatteParts& parts, std::size_t pixel) {
  const std::uint8_t covered = parts.coverage.rgb[3 * pixel];
  return covered != 0 && covered != 255;
}

// Every pixel but those at edges, where programs mix codes and the film mixes light.
TEST(RendererMatte, overItsEmptyStageIsTheFilm) {
  for (const Antialiasing antialiasing :
       {Antialiasing::kOff, Antialiasing::kEdges, Antialiasing::kMultisampled, Antialiasing::kSupersampled}) {
    const Taken taken = takenFrom(crateInRoom(), antialiasing);
    double worst = 0;
    std::size_t edges = 0;
    for (std::size_t i = 0; i < taken.whole.rgb.size(); ++i) {
      if (isEdge(taken.parts, i / 3)) {
        ++edges;
        continue;
      }
      worst = std::max(
          worst, std::abs(over(taken.onNothing, i, taken.parts.emptyStage.rgb[i]) - taken.whole.rgb[i]));
    }
    EXPECT_LE(worst, 1) << nameOf(antialiasing);
    EXPECT_EQ(edges > 0, antialiasing != Antialiasing::kOff) << nameOf(antialiasing);
    EXPECT_LT(edges, 3U * 2 * (kWide + kHigh)) << nameOf(antialiasing);
  }
}

// The film's own light at an edge: covered box and stage, in linear light.
TEST(RendererMatte, edgesOfBoxAndStageMakeTheEdgesOfTheFilm) {
  const Taken taken = takenFrom(crateInRoom());
  const auto light = [](int code) {
    const double value = code / 255.0;
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  };
  std::vector<double> errors;
  for (std::size_t i = 0; i < taken.whole.rgb.size(); ++i) {
    if (isEdge(taken.parts, i / 3)) {
      const double mixed = light(taken.parts.boxes.rgb[i]) +
                           (1 - light(taken.parts.coverage.rgb[i])) * light(taken.parts.stage.rgb[i]);
      errors.push_back(std::abs(mixed - light(taken.whole.rgb[i])));
    }
  }
  ASSERT_GT(errors.size(), 150U);
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() * 9 / 10], 0.004);  // 0.0031
  EXPECT_LT(errors.back(), 0.07);                    // 0.060, where three meet
}

TEST(RendererMatte, whatTheStageHidesIsNotThere) {
  Scene scene = crateInRoom();
  const double top = scene.boxes[0].pose.position.z() + scene.boxes[0].halfExtents.norm();
  scene.boxes[0].pose.position.z() -= top + 0.01;  // under the floor
  const auto mostCovered = [&] {
    const Picture coverage = takenFrom(scene).parts.coverage;
    return *std::max_element(coverage.rgb.begin(), coverage.rgb.end());
  };
  EXPECT_EQ(mostCovered(), 0);
  scene.room.reset();
  EXPECT_EQ(mostCovered(), 255);
}

TEST(RendererMatte, drawingItChangesNoPictureAfterIt) {
  const Scene scene = crateInRoom();
  Renderer renderer(setupOf(scene, kWide, kHigh));
  const std::vector<Pose> poses = posesOf(scene);
  const Shot shot{.poses = poses, .camera = *scene.camera};
  const Picture before = renderer.draw(shot);
  const Picture taken = onNothing(renderer.drawMatte(shot));
  EXPECT_EQ(renderer.draw(shot).rgb, before.rgb);
  const Picture again = onNothing(renderer.drawMatte(shot));
  EXPECT_EQ(again.rgb, taken.rgb);
  EXPECT_EQ(again.alpha, taken.alpha);
}

}  // namespace
}  // namespace careen
