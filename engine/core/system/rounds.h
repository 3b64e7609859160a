#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/system/team.h"

namespace careen {

/// Parts of one piece of work, done round after round by a team, some of which share data: the same comes of
/// it as if one thread did them in their order in every round. No round waits for the end of the one before:
/// a part waits for those alone with which it shares data, of lower number in the same round and of higher
/// in the one before.
///
/// Every thread has parts of its own, so what they write stays in its cache. It does those of others that are
/// not begun only where it would have to wait, so none waits for a thread that gets no core.
class Rounds {
 public:
  /// That many parts, none of which shares anything.
  void begin(std::size_t parts);
  /// Neighbours in 0 ≤ place < 1 are done by one thread where that can be.
  void setPlace(std::size_t part, double place) { parts_[part].place = place; }
  void share(std::size_t part, std::size_t other);

  /// Calls work(part), which returns how much it did and must not throw, until a round of which all did
  /// nothing, at most so many rounds. Returns the sum.
  template <class Work>
  std::int64_t run(Team& team, int most, const Work& work) {
    if (most <= 0) {
      return 0;
    }
    const int threads = std::min(team.size(), static_cast<int>(parts_.size()));
    start(threads, most);
    team.run(threads, [&](int thread) {
      std::int64_t sum = 0;
      for (Turn turn{.thread = thread}; next(turn);) {
        const std::int64_t did = work(turn.part);
        finish(turn, did != 0);
        sum += did;
      }
      sum_.fetch_add(sum, std::memory_order_relaxed);
    });
    return sum_.load(std::memory_order_relaxed);
  }

 private:
  /// What a thread does next: a part, in a round.
  struct Turn {
    int thread = 0;
    int round = 0;  // of its own parts
    bool helps = false;
    std::size_t part = 0;
    int partRound = 0;
  };
  struct alignas(64) Part {
    double place = 0;
    std::vector<std::size_t> sharing;
    std::atomic<int> begun = 0;  // rounds
    std::atomic<int> done = 0;   // rounds · 2, and 1 if it did anything in the last
  };
  enum class Verdict : std::uint8_t { kUnknown, kOver, kGoesOn };
  void start(int threads, int most);
  bool next(Turn& turn);
  bool take(std::size_t part, int round, Turn& turn);
  bool isReady(std::size_t part, int round) const;
  Verdict verdictOf(int round) const;
  void finish(const Turn& turn, bool didAnything);

  std::vector<Part> parts_;
  std::vector<std::vector<std::size_t>> own_;  // parts, by thread
  int most_ = 0;                               // rounds
  std::atomic<std::int64_t> sum_ = 0;
};

}  // namespace careen
