#pragma once

#include <sys/types.h>

#include <atomic>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/system/cleanup.h"

namespace careen {

/// Another program that answers each line on its standard input by one on its standard output. It is ended
/// with this object.
class Dialogue {
 public:
  /// Starts the program, found through PATH. MachineError if it cannot be started.
  explicit Dialogue(const std::vector<std::string>& command);
  ~Dialogue();
  Dialogue(const Dialogue&) = delete;
  Dialogue& operator=(const Dialogue&) = delete;
  Dialogue(Dialogue&&) = delete;
  Dialogue& operator=(Dialogue&&) = delete;

  /// Sends a line, without its end, and returns the answer, likewise. If stopped it ends the program and
  /// throws Interrupted. MachineError with the end of its log if the program ends instead of answering.
  std::string ask(const std::string& line, const std::stop_token& stop);

  /// [s] of cores that the program has taken, also once it has ended. May be called while it is asked.
  double coreSeconds() const;

 private:
  void send(const std::string& line);
  std::string receive();
  [[noreturn]] void fail() const;
  void end();

  std::string name_;
  int ours_ = -1;  // our end of the socket
  int log_ = -1;
  std::atomic<pid_t> process_ = 0;  // 0: has ended
  clockid_t clock_ = 0;
  std::atomic<double> taken_ = 0;  // [s] of cores, once it has ended
  std::string received_;
  std::optional<Cleanup> cleanup_;
};

}  // namespace careen
