#pragma once

#include <atomic>
#include <csignal>
#include <stop_token>
#include <thread>

namespace careen {

/// What is told of an interruption from now on: "careen: interrupted" and this literal, which may be empty.
void setInterruptionHint(const char* hint);
void tellInterruption();

/// Turns SIGINT and SIGTERM into a stop request, so that whatever is being written is finished or undone. If
/// the command has not ended 0.7 s later, or at a second signal, what is unfinished is undone here (see
/// Cleanup) and the process ends by the signal, whatever it is doing. A signal that was ignored when the
/// program started stays ignored.
///
/// Create it before any other thread: they inherit the mask that leaves the signals to its own thread.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  Interruption(Interruption&&) = delete;
  Interruption& operator=(Interruption&&) = delete;

  std::stop_token token() const { return source_.get_token(); }
  /// The signal received, 0 if none.
  int signal() const { return signal_; }

 private:
  void wait();
  void endNow(int signal);

  sigset_t signals_{};
  std::stop_source source_;
  std::atomic<int> signal_ = 0;
  std::atomic<bool> over_ = false;
  std::thread waiter_;
};

}  // namespace careen
