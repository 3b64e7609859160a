#pragma once

#include <ostream>

#include "render/film/film.h"
#include "run.h"

namespace careen {

/// Reports the progress of a film: one line that fills on a terminal, otherwise plain lines every few
/// seconds.
class Progress {
 public:
  Progress(std::ostream& out, bool terminal) : out_(out), terminal_(terminal) {}

  void update(const FilmProgress& film);

 private:
  std::ostream& out_;
  bool terminal_;
  Stopwatch stopwatch_;
  double toldAt_ = 0;  // [s]
};

}  // namespace careen
