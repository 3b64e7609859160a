#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "film/frame_range.h"
#include "sound/ringing.h"
#include "trajectory/trajectory.h"

namespace careen {

/// A film's sound: one channel, kSampleRate samples a second.
struct SoundTrack {
  std::vector<std::int16_t> samples;
  double loudest = 0;  ///< [Pa] at the camera, of the largest sample; 0: nothing is heard
};

/// The largest sample of a track that is not silent: one decibel below what there is.
inline constexpr int kLoudestSample = 29204;

/// The sound of the film of a run from one moment to another [s]: boxes ring where they are struck, and hiss
/// where they slide. As loud as it can be without clipping, so that it tells what is louder than what, and
/// not how loud it is. The same bits everywhere. InputError if the run has no impacts to tell, as a table of
/// poses.
SoundTrack soundTrackOf(const Trajectory& run, double from, double to, Pitch pitch,
                        const std::stop_token& stop = {});

/// That of these frames of its film; all if there are no ranges. InputError, too, if they do not follow each
/// other.
SoundTrack soundTrackOf(const Trajectory& run, std::span<const FrameRange> frames, Pitch pitch,
                        const std::stop_token& stop = {});

/// As a WAV file (RIFF, PCM, 16 bits).
std::string wavOf(const SoundTrack& track);

}  // namespace careen
