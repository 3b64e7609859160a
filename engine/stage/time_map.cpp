#include "stage/time_map.h"

#include <algorithm>
#include <iterator>

#include "core/brief.h"
#include "core/error.h"

namespace careen {

double TimeMap::sceneTime(double filmTime) const {
  if (keys.empty()) {
    return filmTime;
  }
  const auto next = std::upper_bound(keys.begin(), keys.end(), filmTime,
                                     [](double time, const TimeKey& key) { return time < key.film; });
  if (next == keys.begin()) {
    return keys.front().scene;
  }
  if (next == keys.end()) {
    return keys.back().scene;
  }
  const TimeKey& last = *std::prev(next);
  const double speed = (next->scene - last.scene) / (next->film - last.film);
  return std::min(next->scene, last.scene + (filmTime - last.film) * speed);
}

TimeMap TimeMap::within(double runDuration) const {
  if (keys.empty()) {
    return {.keys = {{.film = 0, .scene = 0}, {.film = runDuration, .scene = runDuration}}};
  }
  if (keys.front().scene >= runDuration) {
    throw InputError("found a film that begins at " + brief(keys.front().scene) +
                     " s of the scene, expected one that begins before the run's end at " +
                     brief(runDuration) + " s");
  }
  TimeMap cut;
  for (const TimeKey& key : keys) {
    if (key.scene > runDuration) {
      const TimeKey& last = cut.keys.back();
      const double part = (runDuration - last.scene) / (key.scene - last.scene);
      cut.keys.push_back({.film = last.film + part * (key.film - last.film), .scene = runDuration});
      break;
    }
    cut.keys.push_back(key);
  }
  return cut;
}

}  // namespace careen
