#pragma once

#include <array>

#include "trajectory/exporter.h"

namespace careen {

/// poses.csv: one row per body and sample, samples at k · every [s] from 0 to the end of the run. World
/// frame, 17 significant digits; of the two quaternions of an orientation the one whose first non-zero
/// component is positive.
void writePosesCsv(const Trajectory& trajectory, double every, const TextSink& sink);

/// Columns of a table of impacts, after its time and the names of both.
struct ImpactColumn {
  const char* name;
  const char* unit;
  double (*of)(const Impact& impact);
};
inline constexpr std::array<ImpactColumn, 9> kImpactColumns = {
    {{"x", "m", [](const Impact& impact) { return impact.point.x(); }},
     {"y", "m", [](const Impact& impact) { return impact.point.y(); }},
     {"z", "m", [](const Impact& impact) { return impact.point.z(); }},
     {"nx", "1", [](const Impact& impact) { return impact.normal.x(); }},
     {"ny", "1", [](const Impact& impact) { return impact.normal.y(); }},
     {"nz", "1", [](const Impact& impact) { return impact.normal.z(); }},
     {"approach", "m/s", [](const Impact& impact) { return impact.approach; }},
     {"impulse", "N s", [](const Impact& impact) { return impact.impulse; }},
     {"tangential", "N s", [](const Impact& impact) { return impact.tangential; }}}};

/// impacts.csv: one row per contact point of an impact, in order of time.
void writeImpactsCsv(const Trajectory& trajectory, const TextSink& sink);

/// joints.csv: one row per hinge or slider and sample, samples as in poses.csv; columns as in JointSamples.
void writeJointsCsv(const Trajectory& trajectory, double every, const TextSink& sink);

/// forces.csv: one row per sample and point at which a contact pushes, samples as in poses.csv; columns of
/// kForceColumns.
void writeForcesCsv(const Trajectory& trajectory, double every, const TextSink& sink);

/// energy.csv: one row per sample, samples as in poses.csv; columns of kEnergyColumns.
void writeEnergyCsv(const Trajectory& trajectory, double every, const TextSink& sink);

}  // namespace careen
