#include "status_line.h"

#include <unistd.h>

#include <algorithm>
#include <iostream>

#include "terminal_text.h"

namespace careen {
namespace {

constexpr double kShowEvery = 0.2;  // [s]

}  // namespace

StatusLine::StatusLine() : terminal_(isatty(STDERR_FILENO) != 0) {}

void StatusLine::show(const std::string& text) {
  if (terminal_ && stopwatch_.seconds() - shownAt_ >= kShowEvery) {
    shownAt_ = stopwatch_.seconds();
    write(text);
  }
}

void StatusLine::keep(const std::string& text) {
  if (terminal_) {
    write(text);
    std::cerr << '\n' << std::flush;
    length_ = 0;
  }
}

void StatusLine::clear() {
  if (length_ > 0) {
    write("");
    std::cerr << '\r' << std::flush;
  }
}

void StatusLine::write(std::string text) {
  // A longer line would begin another, and could not be rewritten.
  text.resize(std::min(text.size(), terminalColumns(STDERR_FILENO, 80) - 1));
  const std::size_t length = text.size();
  text.append(length_ > length ? length_ - length : 0, ' ');  // over the rest of a longer one
  std::cerr << '\r' << text << std::flush;
  length_ = length;
}

}  // namespace careen
