#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "stage/time_map.h"

namespace careen {

/// [1/s] Samples of a film's sound.
inline constexpr int kSampleRate = 48000;

/// Samples that follow each other, from each of which to the next as much of the scene passes.
struct SampleRun {
  std::int64_t first = 0;
  std::int64_t end = 0;  ///< one past the last
  double sceneStep = 0;  ///< [s] 0: the picture is frozen
};

/// The moments of the samples of a film: sample k is at k / kSampleRate [s] of it.
class FilmClock {
 public:
  /// `clock` has keys.
  explicit FilmClock(TimeMap clock) : clock_(std::move(clock)) {}

  double duration() const { return clock_.duration(); }  ///< [s]
  double sceneTime(double filmTime) const { return clock_.sceneTime(filmTime); }
  /// When the film first shows this moment of the scene [s]; nothing if it does not.
  std::optional<double> filmTime(double sceneTime) const;
  /// Of the samples from `first` until before `end`, in order; a step over a key of the film's time is a run
  /// of its own.
  std::vector<SampleRun> runs(std::int64_t first, std::int64_t end) const;

 private:
  TimeMap clock_;
};

}  // namespace careen
