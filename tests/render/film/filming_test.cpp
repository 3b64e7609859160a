#include "render/film/filming.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "render/draw/renderer.h"
#include "render/stage.h"
#include "view/materials.h"

namespace careen {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 90;
constexpr FrameRate kRate = {.numerator = 10, .denominator = 1};

class FilmingTest : public testing::Test {
 protected:
  // Of the run as it is now shown; it keeps that by reference.
  Filming filming() {
    run_.stage = setupOf(scene_, kWidth, kHeight).stage;
    return Filming(run_);
  }
  Picture plain(double time) { return filming().draw(renderer_, time, {}, kRate); }

  Scene scene_ = crateInRoom();
  Trajectory run_ = drifting(scene_, Vec3(3, 0, 0.5));
  Renderer renderer_{setupOf(scene_, kWidth, kHeight)};
};

TEST_F(FilmingTest, showsTheRunByTheFilmsTime) {
  scene_.timeMap.keys = {{0, 0}, {0.5, 0.5}, {2.5, 0.6}};
  EXPECT_EQ(plain(0.25).rgb, renderer_.draw(run_.poses(0.25)).rgb);
  EXPECT_EQ(plain(1.5).rgb, renderer_.draw(run_.poses(scene_.timeMap.sceneTime(1.5))).rgb);
  EXPECT_EQ(filming().duration(), 2.5);
}

// Each sample on its own, averaged in doubles beside the engine.
TEST_F(FilmingTest, blurIsTheAverageOfTheLightOfItsSamples) {
  scene_.cameraMove.orbitDegrees = 100;  // the camera moves as well
  const Shutter shutter = {.degrees = 270, .samples = 5};
  const Picture blurred = filming().draw(renderer_, 0.5, shutter, kRate);
  std::vector<double> light(blurred.rgb.size());
  for (int i = 0; i < 5; ++i) {
    const Picture sample = plain(0.5 + 0.075 * (i - 2) / 5);  // 3/4 of 0.1 s, the middles of its fifths
    for (std::size_t k = 0; k < light.size(); ++k) {
      light[k] += linearFromSrgb({sample.rgb[k], 0, 0}).x() / 5;
    }
  }
  int different = 0;
  for (std::size_t k = 0; k < light.size(); ++k) {
    EXPECT_NEAR(blurred.rgb[k], srgbFromLinear(light[k]), 1);
    different += blurred.rgb[k] == srgbFromLinear(light[k]) ? 0 : 1;
  }
  EXPECT_LT(different, 20);
  EXPECT_NE(blurred.rgb, plain(0.5).rgb);
}

TEST_F(FilmingTest, turnedCameraIsTurnedFromWhereTheFilmHasIt) {
  scene_.cameraMove.orbitDegrees = 100;
  Filming film = filming();
  const Orbit orbit = {.azimuth = 0.5, .elevation = 0.1, .distance = 1.5};
  const Camera own = film.camera(0.7);
  film.turnCamera(orbit);
  EXPECT_EQ(film.camera(0.7).eye, orbited(own, orbit).eye);
  const std::vector<Pose> poses = run_.poses(0.7);
  EXPECT_EQ(film.draw(renderer_, 0.7, {}, kRate).rgb,
            renderer_.draw({.poses = poses, .camera = orbited(own, orbit)}).rgb);
  film.turnCamera({});
  EXPECT_EQ(film.camera(0.7).eye, own.eye);
}

TEST_F(FilmingTest, whereNothingMovesBlurChangesNothingAndCostsNothing) {
  scene_.timeMap.keys = {{0, 0.3}, {2, 0.3}};
  const Picture still = plain(1);
  const int before = renderer_.figures().frames;
  EXPECT_EQ(filming().draw(renderer_, 1, {.degrees = 180, .samples = 16}, kRate).rgb, still.rgb);
  EXPECT_EQ(renderer_.figures().frames, before + 1);
}

// Half of the shutter's time lies before the film's beginning, where all stands still.
TEST_F(FilmingTest, blurAtTheFilmsEndsStaysWithinIt) {
  for (const double end : {0.0, 1.0}) {
    const int before = renderer_.figures().frames;
    filming().draw(renderer_, end, {.degrees = 360, .samples = 8}, kRate);
    EXPECT_EQ(renderer_.figures().frames, before + 5);
  }
}

// Of a lens 0.8 m wide: 24 mm high, 40° of view, so 33 mm of focal length over 0.0412.
TEST_F(FilmingTest, pointsOfTheLensAreAllOverItAndWhatIsSharpStaysSharp) {
  scene_.camera = cameraAt(Vec3(0, -8, 1), Vec3(0, 0, 1), 40);
  scene_.focus = Focus{.fStop = 0.0412, .distance = 8.0, .samples = 40};
  const Filming film = filming();
  const double radius = 0.012 / std::tan(20 * std::numbers::pi / 180) / 0.0412 / 2;
  std::array<int, 4> inQuarter{};
  int inner = 0;
  for (int k = 0; k < 40; ++k) {
    const Camera seen = film.camera(0, k, 40);
    EXPECT_EQ(seen.sharpAt, 8);
    EXPECT_LT(seen.beside.norm(), radius);
    inner += seen.beside.norm() < radius / std::sqrt(2.0) ? 1 : 0;
    inQuarter.at((seen.beside.x() > 0 ? 1U : 0U) + (seen.beside.y() > 0 ? 2U : 0U)) += 1;
  }
  EXPECT_EQ(inner, 20) << "half of them on half of its area";
  for (const int count : inQuarter) {
    EXPECT_NEAR(count, 10, 2);
  }
  const Picture drawn = film.draw(renderer_, 0.5, {}, kRate);
  EXPECT_EQ(renderer_.figures().frames, 40);
  scene_.focus.reset();
  EXPECT_NE(drawn.rgb, plain(0.5).rgb);
}

TEST_F(FilmingTest, aLensIsSharpAtABox) {
  scene_.camera = cameraAt(Vec3(0, -8, 1), Vec3(0, 0, 1), 40);
  scene_.focus = Focus{.fStop = 1, .body = 0};
  const Vec3 at = run_.poses(0.5)[0].position;
  EXPECT_NEAR(filming().camera(0.5, 0, 32).sharpAt, at.y() + 8, 1e-12);
}

TEST_F(FilmingTest, strobeHasEveryMoment) {
  RenderOptions options;
  options.lighting = evenLighting(Vec3::Constant(0.1));  // without shadows boxes leave the rest as it is
  options.materials = materialsOf(scene_.picture.look);
  options.materials->occlusion = false;
  Renderer renderer(setupOf(scene_, kWidth, kHeight), options);
  run_ = drifting(scene_, Vec3(2.5, 0, 0));
  scene_.boxes[0].pose.position.x() = 0;
  const std::vector<double> times = {0, 0.4, 0.8};
  const Picture strobe = filming().drawStrobe(renderer, times);
  Scene bare = scene_;
  bare.boxes.clear();
  options.camera = scene_.camera;
  const Picture empty = Renderer(setupOf(bare, kWidth, kHeight), options).draw(std::vector<Pose>());
  std::array<int, 3> seen{};
  for (std::size_t moment = 0; moment < times.size(); ++moment) {
    const Picture single = filming().draw(renderer, times[moment], {}, kRate);
    for (std::size_t k = 0; k < single.rgb.size(); ++k) {
      if (single.rgb[k] != empty.rgb[k]) {
        seen.at(moment) += strobe.rgb[k] == single.rgb[k] ? 1 : 0;
      }
    }
    EXPECT_GT(seen.at(moment), 300) << moment;
  }
  int drawn = 0;
  for (std::size_t k = 0; k < strobe.rgb.size(); ++k) {
    drawn += strobe.rgb[k] != empty.rgb[k] ? 1 : 0;
  }
  // Edges where two moments meet may be of both.
  EXPECT_NEAR(seen[0] + seen[1] + seen[2], drawn, 0.05 * drawn);
}

TEST_F(FilmingTest, strobeOfOneMomentIsItsPicture) {
  EXPECT_EQ(filming().drawStrobe(renderer_, std::vector<double>{0.3}).rgb, plain(0.3).rgb);
}

}  // namespace
}  // namespace careen
