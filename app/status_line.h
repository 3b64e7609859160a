#pragma once

#include <cstddef>
#include <string>

#include "run_options.h"

namespace careen {

/// One line of standard error that tells how far something is and is rewritten; shown on a terminal only.
class StatusLine {
 public:
  StatusLine();
  ~StatusLine() { clear(); }
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;
  StatusLine(StatusLine&&) = delete;
  StatusLine& operator=(StatusLine&&) = delete;

  bool isOnTerminal() const { return terminal_; }
  /// At most five times a second; what comes sooner is not shown.
  void show(const std::string& text);
  /// Shows it at once, for good.
  void keep(const std::string& text);
  /// Before something else is printed.
  void clear();

 private:
  void write(std::string text);

  bool terminal_ = false;
  Stopwatch stopwatch_;
  double shownAt_ = 0;      // [s]
  std::size_t length_ = 0;  // of what is there
};

}  // namespace careen
