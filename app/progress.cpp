#include "progress.h"

#include <cstdint>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>

namespace careen {
namespace {

constexpr std::int64_t kBarWidth = 30;
constexpr double kPlainInterval = 5;  // [s]

std::string barOf(std::int64_t done, std::int64_t total) {
  const auto filled = static_cast<std::size_t>(kBarWidth * done / total);
  return "[" + std::string(filled, '#') + std::string(static_cast<std::size_t>(kBarWidth) - filled, '.') +
         "] ";
}

}  // namespace

void Progress::update(const FilmProgress& film) {
  std::ostringstream words;
  words << std::fixed << std::setprecision(1) << "frame " << film.done << " of " << film.total;
  if (film.framesPerSecond > 0) {
    words << ", " << film.framesPerSecond << " frames/s, " << film.secondsLeft << " s left";
  }
  const bool last = film.done == film.total;
  if (line_.isOnTerminal()) {
    const std::string text = barOf(film.done, film.total) + words.str();
    last ? line_.keep(text) : line_.show(text);
  } else if (last || stopwatch_.seconds() - toldAt_ >= kPlainInterval) {
    toldAt_ = stopwatch_.seconds();
    std::cerr << words.str() << '\n' << std::flush;
  }
}

}  // namespace careen
