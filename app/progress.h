#pragma once

#include "render/film/film.h"
#include "run_options.h"
#include "status_line.h"

namespace careen {

/// Reports the progress of a film on standard error: one line that fills on a terminal, otherwise plain lines
/// every few seconds.
class Progress {
 public:
  void update(const FilmProgress& film);

 private:
  StatusLine line_;
  Stopwatch stopwatch_;
  double toldAt_ = 0;  // [s]
};

}  // namespace careen
