#include "core/system/rounds.h"

namespace careen {
namespace {

constexpr int kOwnLooks = 64;  // looks at its own parts before a thread does others': some 5 µs

}  // namespace

void Rounds::begin(std::size_t parts) {
  if (parts_.size() != parts) {
    parts_ = std::vector<Part>(parts);
  }
  for (Part& part : parts_) {
    part.place = 0;
    part.sharing.clear();
  }
}

void Rounds::share(std::size_t part, std::size_t other) {
  parts_[part].sharing.push_back(other);
  parts_[other].sharing.push_back(part);
}

void Rounds::start(int threads, int most) {
  most_ = most;
  sum_ = 0;
  own_.resize(static_cast<std::size_t>(threads));
  for (std::vector<std::size_t>& own : own_) {
    own.clear();
  }
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    parts_[k].begun.store(0, std::memory_order_relaxed);
    parts_[k].done.store(0, std::memory_order_relaxed);
    own_[static_cast<std::size_t>(parts_[k].place * threads)].push_back(k);
  }
}

bool Rounds::next(Turn& turn) {
  for (int looks = 0;; ++looks) {
    bool allBegun = true;
    for (const std::size_t part : own_[static_cast<std::size_t>(turn.thread)]) {
      if (parts_[part].begun.load(std::memory_order_relaxed) <= turn.round) {
        if (take(part, turn.round, turn)) {
          return true;
        }
        allBegun = false;
      }
    }
    if (allBegun) {
      const Verdict verdict = verdictOf(turn.round);
      if (verdict == Verdict::kOver) {
        return false;
      }
      if (verdict == Verdict::kGoesOn) {
        ++turn.round;
        looks = 0;
        continue;
      }
    }
    if (turn.helps || looks >= kOwnLooks) {
      for (std::size_t part = 0; part < parts_.size(); ++part) {
        const int round = parts_[part].begun.load(std::memory_order_relaxed);
        if (round <= turn.round && take(part, round, turn)) {
          turn.helps = true;
          return true;
        }
      }
    }
    Team::pause(looks);
  }
}

bool Rounds::take(std::size_t part, int round, Turn& turn) {
  if (!isReady(part, round) ||
      !parts_[part].begun.compare_exchange_strong(round, round + 1, std::memory_order_relaxed)) {
    return false;
  }
  turn.part = part;
  turn.partRound = round;
  return true;
}

bool Rounds::isReady(std::size_t part, int round) const {
  const auto isDone = [&](std::size_t other, int rounds) {
    return parts_[other].done.load(std::memory_order_acquire) >= 2 * rounds;
  };
  bool ready = isDone(part, round);
  for (const std::size_t other : parts_[part].sharing) {
    ready = ready && isDone(other, other < part ? round + 1 : round);
  }
  return ready;
}

// Whether another round follows that one. Where a part is done with more, it does. The last is over for who
// could only wait for its parts.
Rounds::Verdict Rounds::verdictOf(int round) const {
  Verdict verdict = Verdict::kOver;
  if (round + 1 == most_) {
    for (const Part& part : parts_) {
      verdict = part.begun.load(std::memory_order_relaxed) < most_ ? Verdict::kUnknown : verdict;
    }
    return verdict;
  }
  for (const Part& part : parts_) {
    const int done = part.done.load(std::memory_order_acquire);
    if (done / 2 > round + 1 || done == 2 * (round + 1) + 1) {
      return Verdict::kGoesOn;
    }
    verdict = done < 2 * (round + 1) ? Verdict::kUnknown : verdict;
  }
  return verdict;
}

void Rounds::finish(const Turn& turn, bool didAnything) {
  parts_[turn.part].done.store(2 * (turn.partRound + 1) + (didAnything ? 1 : 0), std::memory_order_release);
}

}  // namespace careen
