#pragma once

#include <vector>

namespace careen {

/// At this moment of the film one sees this moment of the scene.
struct TimeKey {
  double film = 0;   ///< [s]
  double scene = 0;  ///< [s]
};

/// Which moment of the scene a film shows: linear between keys, the first key's before it, the last one's
/// after it. Equal scene times are a freeze frame, a slope below 1 is slow motion. Without keys the two are
/// the same.
struct TimeMap {
  std::vector<TimeKey> keys;  ///< film times rise, scene times do not fall

  /// [s] Exact at keys.
  double sceneTime(double filmTime) const;
  /// The part of it that shows a run of this length [s]; it has keys, and its last one is the film's end.
  /// InputError if the film begins after the run's end.
  TimeMap within(double runDuration) const;
  /// [s] of the film; there must be keys.
  double duration() const { return keys.back().film; }
};

}  // namespace careen
