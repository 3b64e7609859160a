#include "sound/film_clock.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace careen {

std::optional<double> FilmClock::filmTime(double sceneTime) const {
  const std::vector<TimeKey>& keys = clock_.keys;
  if (sceneTime < keys.front().scene || sceneTime > keys.back().scene) {
    return std::nullopt;
  }
  const auto next = std::lower_bound(keys.begin(), keys.end(), sceneTime,
                                     [](const TimeKey& key, double time) { return key.scene < time; });
  if (next == keys.begin() || next->scene == sceneTime) {
    return next->film;
  }
  const TimeKey& last = *std::prev(next);
  return last.film + (sceneTime - last.scene) / (next->scene - last.scene) * (next->film - last.film);
}

std::vector<SampleRun> FilmClock::runs(std::int64_t first, std::int64_t end) const {
  std::vector<SampleRun> runs;
  const auto timeOf = [](std::int64_t sample) { return static_cast<double>(sample) / kSampleRate; };
  const auto addUntil = [&](std::int64_t until, double step) {
    if (until > first) {
      runs.push_back({.first = first, .end = until, .sceneStep = step});
      first = until;
    }
  };
  for (std::size_t k = 0; k + 1 < clock_.keys.size() && first < end; ++k) {
    const TimeKey& from = clock_.keys[k];
    const TimeKey& to = clock_.keys[k + 1];
    const auto last = static_cast<std::int64_t>(std::floor(to.film * kSampleRate));
    addUntil(std::min(last, end), (to.scene - from.scene) / (to.film - from.film) / kSampleRate);
    if (first < end && first == last) {
      addUntil(last + 1, clock_.sceneTime(timeOf(last + 1)) - clock_.sceneTime(timeOf(last)));
    }
  }
  addUntil(end, 0);
  return runs;
}

}  // namespace careen
