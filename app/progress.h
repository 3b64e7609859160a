#pragma once

#include <ostream>

#include "render/film/film.h"
#include "run.h"

namespace careen {

/// Tells how far a film is: one line that fills on a terminal, plain lines every few seconds anywhere else.
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
