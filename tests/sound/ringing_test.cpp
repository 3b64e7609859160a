#include "sound/ringing.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sound/block_modes.h"
#include "sound/heard.h"

namespace careen {
namespace {

std::vector<double> rung(const Trajectory& run, Pitch pitch = Pitch::kSlows, std::int64_t first = 0) {
  const TimeMap shown = run.stage.timeMap.within(run.settings.duration);
  const FilmClock clock(shown);
  std::vector<double> samples(static_cast<std::size_t>(std::ceil(shown.duration() * kSampleRate)) -
                              static_cast<std::size_t>(first));
  addRinging(samples, first, run, clock, strikesOf(run, clock, CameraPath(run, shown, 1)), pitch);
  return samples;
}

std::size_t firstHeard(const std::vector<double>& samples) {
  const auto found = std::find_if(samples.begin(), samples.end(), [](double each) { return each != 0; });
  return static_cast<std::size_t>(found - samples.begin());
}

// At 0.447… s: not at a sample. Nothing is heard before, and the sine begins at 0.
TEST(Ringing, beginsWithTheImpactWithinOneSampleAndDoesNotJump) {
  for (const double height : {1.0, 0.7, 0.123, 2.5}) {
    const Trajectory run = dropped(height);
    const double time = run.impacts[0].time;
    EXPECT_NEAR(time, std::sqrt(2 * height / 10), 1e-12);
    const std::vector<double> samples = rung(run);
    const std::size_t first = firstHeard(samples);
    EXPECT_GE(static_cast<double>(first), time * kSampleRate);
    EXPECT_LE(static_cast<double>(first), time * kSampleRate + 1);
    const double largest = *std::max_element(samples.begin(), samples.end());
    EXPECT_LT(std::fabs(samples[first]), 0.15 * largest) << height;  // measured at most 0.12
  }
}

// Tones of its bending modes are louder than those 6 % beside them: measured 22 times and more.
TEST(Ringing, hasTheTonesOfTheBlock) {
  Trajectory run = dropped(1);
  run.stage.boxSounds = {{.modulus = 11e9, .density = 600, .damping = 0.002}};
  const std::vector<double> samples = rung(run);
  int checked = 0;
  for (const BlockMode& mode : modesOf(Vec3(0.5, 0.2, 0.1), run.stage.boxSounds[0], 4000, 100)) {
    if (mode.kind == BlockMode::Kind::kBending && mode.across == 2 && mode.order % 2 == 1 &&
        mode.along == 0) {
      const std::span<const double> ring = std::span(samples).subspan(firstHeard(samples), 9600);
      EXPECT_GT(toneIn(ring, mode.frequency), 15 * toneIn(ring, 1.06 * mode.frequency)) << mode.frequency;
      EXPECT_GT(toneIn(ring, mode.frequency), 15 * toneIn(ring, 0.94 * mode.frequency)) << mode.frequency;
      ++checked;
    }
  }
  EXPECT_GE(checked, 1);
}

// All pressure goes with the impulse: from four times the height it is twice as much, and brighter, so a bit
// more.
TEST(Ringing, isAsLoudAsTheImpact) {
  const auto loudest = [](const std::vector<double>& samples) {
    return *std::max_element(samples.begin(), samples.end());
  };
  const double ratio = loudest(rung(dropped(0.8))) / loudest(rung(dropped(0.2)));
  EXPECT_GT(ratio, 2);
  EXPECT_LT(ratio, 2.4);  // measured 2.26
}

// In a film at half the speed, every other sample is one of the film at full speed.
TEST(Ringing, inSlowMotionIsLowerAndSlower) {
  Trajectory run = dropped(1);
  const std::vector<double> normal = rung(run);
  run.stage.timeMap.keys = {{0, 0}, {2, 1}};
  const std::vector<double> slow = rung(run);
  ASSERT_EQ(slow.size(), 2 * normal.size());
  const std::vector<BlockMode> high = modesOf(Vec3(0.5, 0.2, 0.1), {}, 40'000, 24);
  EXPECT_LT(high.back().frequency, 20'000) << "or there were more modes in the slow film";
  const double largest = *std::max_element(normal.begin(), normal.end());
  for (std::size_t k = 0; k < normal.size(); ++k) {
    ASSERT_NEAR(slow[2 * k], normal[k], 1e-11 * largest) << k;  // measured 5e-13
  }
}

TEST(Ringing, inSlowMotionCanKeepItsPitch) {
  Trajectory run = dropped(1);
  const std::vector<double> normal = rung(run);
  run.stage.timeMap.keys = {{0, 0}, {2, 1}};
  const std::vector<double> slow = rung(run, Pitch::kStays);
  const std::size_t first = firstHeard(slow);
  EXPECT_NEAR(static_cast<double>(first), 2 * run.impacts[0].time * kSampleRate, 1);
  // The same ring, begun between other samples: its tones have the same power.
  const std::span<const double> here = std::span(slow).subspan(first, 4800);
  const std::span<const double> there = std::span(normal).subspan(firstHeard(normal), 4800);
  for (const double tone : {171.5, 400.0, 900.0}) {
    EXPECT_NEAR(toneIn(here, tone), toneIn(there, tone), 0.002 * toneIn(there, tone)) << tone;
  }
}

TEST(Ringing, fallsSilentWhereThePictureIsFrozen) {
  Trajectory run = dropped(1);
  run.stage.boxSounds = {{.modulus = 11e9, .density = 600, .damping = 1e-4}};
  const double hit = run.impacts[0].time;
  run.stage.timeMap.keys = {{0, 0}, {hit + 0.01, hit + 0.01}, {hit + 1, hit + 0.01}, {hit + 1.5, hit + 0.51}};
  const std::vector<double> samples = rung(run);
  const auto at = [&](double time) { return samples[static_cast<std::size_t>(time * kSampleRate)]; };
  EXPECT_NE(at(hit + 0.005), 0);
  EXPECT_EQ(at(hit + 0.6), 0);
  double jump = 0;
  double largest = 0;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    jump = std::max(jump, std::fabs(samples[k] - samples[k - 1]));
    largest = std::max(largest, std::fabs(samples[k]));
  }
  EXPECT_LT(jump, 0.15 * largest);  // measured 0.123
}

// A part of a film has the samples of the whole.
TEST(Ringing, ofAPartIsThatOfTheWhole) {
  const Trajectory run = dropped(0.2);
  const std::vector<double> whole = rung(run);
  const std::vector<double> part = rung(run, Pitch::kSlows, 9000);
  EXPECT_TRUE(std::equal(part.begin(), part.end(), whole.begin() + 9000));
}

}  // namespace
}  // namespace careen
