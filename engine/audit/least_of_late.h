#pragma once

#include <deque>

namespace careen {

/// The least value of late: of those in the last `span` [s], and of one before.
class LeastOfLate {
 public:
  explicit LeastOfLate(double span) : span_(span) {}
  double with(double time, double value) {
    if (!rising_.empty()) {
      rising_.back().next = time;
    }
    while (!rising_.empty() && rising_.back().value >= value) {
      rising_.pop_back();
    }
    while (!rising_.empty() && rising_.front().next < time - span_) {
      rising_.pop_front();
    }
    rising_.push_back({.next = time, .value = value});
    return rising_.front().value;
  }
  /// All values so far are that much more.
  void shift(double by) {
    for (Each& each : rising_) {
      each.value += by;
    }
  }

 private:
  struct Each {
    double next = 0;  // [s] of the value after it
    double value = 0;
  };
  double span_;
  std::deque<Each> rising_;  // values that may yet be the least
};

}  // namespace careen
