#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>

namespace careen {

/// A stop token that also fires when the time is up.
class Deadline {
 public:
  Deadline(double seconds, const std::stop_token& outer)
      : relay_(outer, [this] { source_.request_stop(); }),
        timer_([this, seconds](const std::stop_token& end) {
          std::unique_lock lock(mutex_);
          ended_.wait_for(lock, end, std::chrono::duration<double>(seconds), [] { return false; });
          if (!end.stop_requested()) {
            source_.request_stop();
          }
        }) {}

  std::stop_token token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  std::stop_callback<std::function<void()>> relay_;
  std::mutex mutex_;
  std::condition_variable_any ended_;
  std::jthread timer_;
};

}  // namespace careen
