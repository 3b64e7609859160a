#pragma once

#include <vector>

namespace careen {

/// Maps a film time to a scene time.
struct TimeKey {
  double film = 0;   ///< [s]
  double scene = 0;  ///< [s]
};

/// Scene time as a function of film time: linear between keys; before the first key and after the last,
/// their scene times. Equal scene times are a freeze frame, a slope below 1 is slow motion. Without keys
/// both times are equal.
struct TimeMap {
  std::vector<TimeKey> keys;  ///< film times increase, scene times do not decrease

  /// [s] Exact at keys.
  double sceneTime(double filmTime) const;
  /// The part of the map that shows a run of this length [s]; it has keys, and its last one is the film's
  /// end. InputError if the film begins after the run's end.
  TimeMap within(double runDuration) const;
  /// [s] in film time; needs keys.
  double duration() const { return keys.back().film; }
};

}  // namespace careen
