#pragma once

#include <time.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>

namespace careen {

/// [s] of cores that this program has taken so far. Other programs on the machine do not lengthen it.
inline double coreSeconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// A stop token that also fires when the program has taken so much time of cores.
class Deadline {
 public:
  Deadline(double seconds, const std::stop_token& outer)
      : relay_(outer, [this] { source_.request_stop(); }),
        timer_([this, seconds](const std::stop_token& end) {
          std::unique_lock lock(mutex_);
          const double last = coreSeconds() + seconds;
          for (double left = seconds; left > 0 && !end.stop_requested(); left = last - coreSeconds()) {
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
