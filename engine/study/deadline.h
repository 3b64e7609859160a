#pragma once

#include <time.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>

namespace careen {

/// [s] of cores that this program has taken so far. Other programs on the machine do not lengthen it.
inline double coreSeconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// A stop token that also fires when a clock has gone on by so much: that of the cores that the program
/// takes, or another one.
class Deadline {
 public:
  Deadline(double seconds, const std::stop_token& outer, std::function<double()> clock = coreSeconds)
      : relay_(outer, [this] { source_.request_stop(); }),
        timer_([this, seconds, clock = std::move(clock)](const std::stop_token& end) {
          std::unique_lock lock(mutex_);
          const double last = clock() + seconds;
          for (double left = seconds; left > 0 && !end.stop_requested(); left = last - clock()) {
            ended_.wait_for(lock, end, std::chrono::duration<double>(std::max(left, kLeastWait)),
                            [] { return false; });
          }
          if (!end.stop_requested()) {
            source_.request_stop();
          }
        }) {}

  std::stop_token token() const { return source_.get_token(); }

 private:
  static constexpr double kLeastWait = 1e-3;  // [s]

  std::stop_source source_;
  std::stop_callback<std::function<void()>> relay_;
  std::mutex mutex_;
  std::condition_variable_any ended_;
  std::jthread timer_;
};

}  // namespace careen
