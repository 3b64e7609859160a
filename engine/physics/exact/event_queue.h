#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <queue>
#include <vector>

#include "core/error.h"
#include "core/math/double_double.h"
#include "physics/world/partner.h"

namespace careen {

/// A moment on a world's clock [s]. 32 digits, so that the time since the start of a flight has full double
/// precision however late it started.
using Instant = DoubleDouble;

/// The moment `elapsed` [s] after another. Normalised, else hi would be off by the rounding of the clock;
/// moments are ordered by hi, then lo.
inline Instant instantAfter(const Instant& start, double elapsed) {
  return normalized(start + Instant(elapsed));
}
/// [s] Rounded relative to the difference itself, not to the clock, which would make short hops late in a run
/// inaccurate.
inline double secondsBetween(const Instant& start, const Instant& end) {
  return static_cast<double>(end - start);
}

inline bool earlier(const Instant& x, const Instant& y) {
  return x.hi < y.hi || (x.hi == y.hi && x.lo < y.lo);
}
inline const Instant& later(const Instant& x, const Instant& y) { return earlier(x, y) ? y : x; }

enum class EventKind {
  kContact,   ///< the gap to the partner closes (time of impact)
  kTouching,  ///< the gap to the partner stays zero
  kCrossing,  ///< the body enters another cell of the neighbour search
  kStep,      ///< a step of the body's island ends
};

/// The next event of one body. Bodies, also as partners, are given by rank, their position in the order of
/// names.
struct Event {
  static constexpr int kNobody = -1;

  Instant time;
  EventKind kind = EventKind::kContact;
  int body = 0;
  int partner = kNobody;
  std::uint64_t partnerMotion = 0;  ///< the motion of the partner that this prediction is for
};

/// The next event of every body, earliest first; ties in the order of bodies. A body has one event at most:
/// setting it again replaces it. An event at no moment, of a motion that has no finite numbers, is refused:
/// it would put all others out of order.
class EventQueue {
 public:
  explicit EventQueue(std::size_t bodies) : tickets_(bodies, 0) {}

  void set(const Event& event) {
    if (!std::isfinite(event.time.hi)) {
      throw NumericalError("the next event of a body is at no moment: its motion has lost its numbers");
    }
    heap_.push({event, ++tickets_[static_cast<std::size_t>(event.body)]});
  }
  void clear(int body) { ++tickets_[static_cast<std::size_t>(body)]; }
  /// Removes and returns the earliest event.
  std::optional<Event> next() {
    while (!heap_.empty()) {
      const Entry entry = heap_.top();
      heap_.pop();
      if (entry.ticket == tickets_[static_cast<std::size_t>(entry.event.body)]) {
        return entry.event;
      }
    }
    return std::nullopt;
  }

 private:
  struct Entry {
    Event event;
    std::uint64_t ticket;
  };
  struct Later {
    bool operator()(const Entry& x, const Entry& y) const {
      if (earlier(y.event.time, x.event.time)) {
        return true;
      }
      if (earlier(x.event.time, y.event.time)) {
        return false;
      }
      return x.event.body > y.event.body;
    }
  };

  std::priority_queue<Entry, std::vector<Entry>, Later> heap_;
  std::vector<std::uint64_t> tickets_;
};

}  // namespace careen
