#pragma once

#include <cstdint>
#include <string>

#include "physics/motion/run_progress.h"
#include "run_options.h"
#include "status_line.h"

namespace careen {

/// "12 s", "3.5 min", "15 h": whole seconds, rounded up.
std::string inTime(double seconds);

/// Tells how far a simulation is: on a terminal in one line, with `json` on the standard output too, a line
/// at most every half second and one at the end. Both RunCallbacks need this object.
class SimulationProgress {
 public:
  explicit SimulationProgress(bool json) : json_(json) {}

  /// Warns once if the run will have more than so many segments and impacts.
  RunCallback ofRun(std::uint64_t mostRecords);
  /// Of the second run.
  RunCallback ofEstimate();

 private:
  void show(const char* phase, const char* title, const RunProgress& run);
  void warn(const RunProgress& run, std::uint64_t mostRecords);

  bool json_;
  bool warned_ = false;
  double printedAt_ = 0;  // [s]
  StatusLine line_;
};

}  // namespace careen
