#include "sound/sound_track.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "sound/heard.h"

namespace careen {
namespace {

int largest(const SoundTrack& track) {
  int most = 0;
  for (const std::int16_t each : track.samples) {
    most = std::max(most, std::abs(static_cast<int>(each)));
  }
  return most;
}

TEST(SoundTrack, isAsLoudAsItCanBeWithoutClipping) {
  for (const double height : {0.01, 1.0}) {
    const SoundTrack track = soundTrackOf(dropped(height), 0, 1, Pitch::kSlows);
    EXPECT_EQ(track.samples.size(), 48000U);
    EXPECT_EQ(largest(track), kLoudestSample);
  }
}

TEST(SoundTrack, isSilentWhereNothingIsHeard) {
  const SoundTrack track = soundTrackOf(dropped(20), 0, 1, Pitch::kSlows);  // it is in the air all the time
  EXPECT_EQ(track.loudest, 0);
  EXPECT_EQ(largest(track), 0);
  const SoundTrack before = soundTrackOf(dropped(1), 0, 0.4, Pitch::kSlows);
  EXPECT_EQ(largest(before), 0);
}

TEST(SoundTrack, ofATableOfPosesIsRefused) {
  Trajectory run = dropped(1);
  run.given.emplace();
  EXPECT_THROW(soundTrackOf(run, 0, 1, Pitch::kSlows), InputError);
}

// RIFF: sizes and rates as bytes, the lowest first.
TEST(SoundTrack, isAWavFile) {
  const std::string wav = wavOf({.samples = {1, -2}, .loudest = 1});
  const std::string expected =
      std::string("RIFF\x28\0\0\0WAVEfmt \x10\0\0\0\1\0\1\0\x80\xbb\0\0\0\x77\1\0\2\0\x10\0", 36) +
      std::string("data\4\0\0\0\1\0\xfe\xff", 12);
  EXPECT_EQ(wav, expected);
}

}  // namespace
}  // namespace careen
