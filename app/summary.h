#pragma once

#include <cstddef>
#include <ostream>
#include <string>

#include "physics/world/run_settings.h"
#include "runs/run.h"

namespace careen {

/// In words: what moved, its error and speed in a few lines; or, verbose, the same as in the report.
void printSummary(std::ostream& out, const Run& run, double wallSeconds, bool verbose);
/// Parts of the summary.
void printPlan(std::ostream& out, const std::string& scene, std::size_t boxes, const RunSettings& settings,
               const Plan& plan);
void printPlan(std::ostream& out, const Trajectory& run);
/// Which boxes are followed exactly, and which need not be; nothing where none can touch.
void printCrowds(std::ostream& out, const RunSettings& settings, const Plan& plan);
void printError(std::ostream& out, const Run& run);

}  // namespace careen
