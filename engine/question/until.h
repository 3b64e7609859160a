#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>

#include "physics/motion/run_progress.h"
#include "question/question.h"
#include "trajectory/trajectory.h"

namespace careen {

/// A run that ends when a statement becomes true.
struct RunUntil {
  Trajectory run;
  std::optional<double> time;  ///< [s] when it did, and the run's duration; none: never, the run is whole
};

/// Simulates until the first moment after the start at which the statement becomes true, or else to the end.
/// Method exact stops soon after: what is recorded is looked at from time to time, each half as long again as
/// the one before. Others run to the end, and what is beyond is left out. Figures of a run's errors may be of
/// a little more than it is. Throws as record() does.
RunUntil recordUntil(const RunSetup& setup, const Question& question, const std::stop_token& stop = {},
                     std::uint64_t most = kMostRecords, const RunCallback& progress = {});

/// Leaves out all that begins or happens after that time, which is the run's end then.
void endAt(Trajectory& run, double time);

}  // namespace careen
