#include "sound/sliding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "sound/heard.h"

namespace careen {
namespace {

// A box of 2 kg that slides at `speed` [m/s] along a floor with μ = 0.25 and g = 10 m/s², far from its end.
Scene slide(double speed) {
  Scene scene = drop(0);
  scene.boxes[0].velocity = Vec3(speed, 0, 0);
  scene.boxes[0].material = {.restitution = 0, .friction = 0.25};
  scene.walls[0].material.friction = 0.25;
  scene.settings.duration = 0.25;
  return scene;
}

std::vector<double> heard(const Scene& scene, Pitch pitch = Pitch::kSlows) {
  const Trajectory run = record(setupOf(scene));
  const TimeMap shown = run.stage.timeMap.within(run.settings.duration);
  std::vector<double> samples(static_cast<std::size_t>(shown.duration() * kSampleRate));
  addSliding(samples, 0, run, FilmClock(shown), CameraPath(run, shown, 1), pitch);
  return samples;
}

double meanSquare(const std::vector<double>& samples) {
  return std::inner_product(samples.begin(), samples.end(), samples.begin(), 0.0) /
         static_cast<double>(samples.size());
}

// 5 N along the floor: the power is 5 N times the speed, which falls by 2.5 m/s a second. From 8 to 7.375 m/s
// the mean power is 38.4 W; the camera is 4.1 m away from where it begins.
TEST(Sliding, hasThePowerOfFriction) {
  const double eight = meanSquare(heard(slide(8)));
  const double pressure = 3e-5 * 38.4 * 1.2 * 343 / (4 * std::numbers::pi * 17);
  EXPECT_NEAR(eight, pressure, 0.1 * pressure);  // measured 0.92: a quarter of a second of noise
  EXPECT_NEAR(eight / meanSquare(heard(slide(4))), 2.09, 0.12);  // measured 1.99
}

TEST(Sliding, isBrighterIfFaster) {
  const auto brightness = [](const std::vector<double>& samples) {
    double low = 0;
    double high = 0;
    for (int k = 0; k < 40; ++k) {
      low += toneIn(samples, 300 + 10 * k);
      high += toneIn(samples, 6000 + 10 * k);
    }
    return high / low;
  };
  EXPECT_GT(brightness(heard(slide(4))), 5 * brightness(heard(slide(1))));
}

TEST(Sliding, isSilentWhereNothingSlides) {
  Scene rests = slide(0);
  rests.settings.duration = 0.1;
  EXPECT_EQ(meanSquare(heard(rests)), 0);
  Scene smooth = slide(4);
  smooth.walls[0].material.friction = 0;
  EXPECT_EQ(meanSquare(heard(smooth)), 0);
  Scene rides = slide(1);  // on a belt that is as fast
  rides.walls[0].material.surface.velocity = Vec3(1, 0, 0);
  EXPECT_EQ(meanSquare(heard(rides)), 0);
}

TEST(Sliding, isSilentWhereThePictureIsFrozen) {
  Scene scene = slide(8);
  scene.timeMap.keys = {{0, 0}, {0.1, 0.1}, {0.2, 0.1}};
  const std::vector<double> samples = heard(scene);
  EXPECT_NE(samples[4000], 0);
  EXPECT_EQ(samples[9000], 0);
}

}  // namespace
}  // namespace careen
