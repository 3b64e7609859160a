#include "sound/sound_track.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "sound/sliding.h"

namespace careen {
namespace {

void append(std::string& bytes, std::uint32_t number, int size) {
  for (int k = 0; k < size; ++k) {
    bytes.push_back(static_cast<char>(number >> (8 * k) & 0xffU));
  }
}

// Takes off what is too low to be heard: a thud pushes air away once, and that is no tone.
void passHigh(std::vector<double>& samples) {
  constexpr double kLowestTone = 40;  // [Hz]
  constexpr double kPart = 2 * std::numbers::pi * kLowestTone / kSampleRate;
  for (int pass = 0; pass < 2; ++pass) {
    double drift = 0;
    for (double& each : samples) {
      drift += kPart / (1 + kPart) * (each - drift);
      each -= drift;
    }
  }
}

}  // namespace

SoundTrack soundTrackOf(const Trajectory& run, double from, double to, Pitch pitch,
                        const std::stop_token& stop) {
  if (run.given) {
    throw InputError("found a table of poses, expected a run: a table does not tell what struck what");
  }
  const TimeMap shown = run.stage.timeMap.within(run.settings.duration);
  const FilmClock clock(shown);
  const CameraPath camera(run, shown, run.stage.picture.aspect());
  const auto first = static_cast<std::int64_t>(std::llround(from * kSampleRate));
  const auto end = static_cast<std::int64_t>(std::llround(to * kSampleRate));
  std::vector<double> pressure(static_cast<std::size_t>(std::max<std::int64_t>(0, end - first)));
  addRinging(pressure, first, run, clock, strikesOf(run, clock, camera), pitch);
  addSliding(pressure, first, run, clock, camera, pitch, stop);
  passHigh(pressure);
  SoundTrack track;
  for (const double each : pressure) {
    track.loudest = std::max(track.loudest, std::fabs(each));
  }
  const double scale = track.loudest > 0 ? kLoudestSample / track.loudest : 0;
  std::transform(pressure.begin(), pressure.end(), std::back_inserter(track.samples),
                 [scale](double each) { return static_cast<std::int16_t>(std::llround(scale * each)); });
  return track;
}

SoundTrack soundTrackOf(const Trajectory& run, std::span<const FrameRange> ranges, Pitch pitch,
                        const std::stop_token& stop) {
  const FrameRate& rate = run.stage.picture.rate;
  const double duration = run.stage.timeMap.within(run.settings.duration).duration();
  const std::vector<std::int64_t> frames = framesOf(ranges, rate.frameCount(duration));
  for (std::size_t k = 1; k < frames.size(); ++k) {
    if (frames[k] != frames[k - 1] + 1) {
      throw InputError("found frame " + std::to_string(frames[k]) + " after frame " +
                       std::to_string(frames[k - 1]) + ", expected frames that follow each other");
    }
  }
  const double from = frames.empty() ? 0 : rate.frameTime(frames.front());
  const double to = frames.empty() ? 0 : rate.frameTime(frames.back() + 1);
  return soundTrackOf(run, from, to, pitch, stop);
}

std::string wavOf(const SoundTrack& track) {
  constexpr std::uint32_t kBytes = 2;  // of a sample
  const std::size_t size = kBytes * track.samples.size();
  if (size > std::numeric_limits<std::uint32_t>::max() - 36) {
    throw InputError("found a film of " + std::to_string(track.samples.size() / kSampleRate) +
                     " s, expected at most 12 hours of sound");
  }
  std::string bytes = "RIFF";
  append(bytes, static_cast<std::uint32_t>(size) + 36, 4);
  bytes += "WAVEfmt ";
  append(bytes, 16, 4);
  append(bytes, 1, 2);  // PCM
  append(bytes, 1, 2);  // channels
  append(bytes, kSampleRate, 4);
  append(bytes, kBytes * kSampleRate, 4);
  append(bytes, kBytes, 2);
  append(bytes, 8 * kBytes, 2);
  bytes += "data";
  append(bytes, static_cast<std::uint32_t>(size), 4);
  for (const std::int16_t sample : track.samples) {
    append(bytes, static_cast<std::uint16_t>(sample), kBytes);
  }
  return bytes;
}

}  // namespace careen
