#pragma once

#include "trajectory/exporter.h"

namespace careen {

/// poses.csv: one row per body and sample, samples at k · every [s] from 0 to the end of the run. World
/// frame, 17 significant digits; of the two quaternions of an orientation the one whose first non-zero
/// component is positive.
void writePosesCsv(const Trajectory& trajectory, double every, const TextSink& sink);

/// impacts.csv: one row per contact point of an impact, in order of time.
void writeImpactsCsv(const Trajectory& trajectory, const TextSink& sink);

}  // namespace careen
