#include "progress.h"

#include <cstdint>
#include <iomanip>
#include <sstream>
#include <string>

namespace careen {
namespace {

constexpr std::int64_t kBarWidth = 30;
constexpr double kTerminalInterval = 0.1;  // [s]
constexpr double kPlainInterval = 5;       // [s]

std::string barOf(std::int64_t done, std::int64_t total) {
  const auto filled = static_cast<std::size_t>(kBarWidth * done / total);
  return "[" + std::string(filled, '#') + std::string(static_cast<std::size_t>(kBarWidth) - filled, '.') +
         "] ";
}

}  // namespace

void Progress::update(const FilmProgress& film) {
  const double now = stopwatch_.seconds();
  const bool last = film.done == film.total;
  if (!last && now - toldAt_ < (terminal_ ? kTerminalInterval : kPlainInterval)) {
    return;
  }
  toldAt_ = now;
  std::ostringstream line;
  line << std::fixed << std::setprecision(1);
  if (terminal_) {
    line << '\r' << barOf(film.done, film.total);
  }
  line << "frame " << film.done << " of " << film.total;
  if (film.framesPerSecond > 0) {
    line << ", " << film.framesPerSecond << " frames/s, " << film.secondsLeft << " s left";
  }
  // Blanks erase the rest of a longer line on a terminal.
  line << (terminal_ ? (last ? "    \n" : "    ") : "\n");
  out_ << line.str() << std::flush;
}

}  // namespace careen
