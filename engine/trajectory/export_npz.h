#pragma once

#include <string>

#include "trajectory/trajectory.h"

namespace careen {

/// A run as NumPy loads it, an NPZ archive. Poses at k · every [s], as in poses.csv: `time` [times], `box`
/// [boxes], and `x` … `wz` [times × boxes]. Impacts, a row for each contact point, as in impacts.csv:
/// `impact_time`, `impact_a`, `impact_b` (names), `impact_x` … `impact_tangential`. Energies at the times of
/// the poses, as in energy.csv: `energy_translation` … `energy_lz`; momenta have the prefix too. `units`:
/// name and unit of each array. InputError as writePosesCsv(), and beyond 20 million rows.
std::string encodeNpz(const Trajectory& trajectory, double every);
/// Forces of contact likewise, a row for each point at which one pushes, as in forces.csv: `time`, `a`, `b`
/// (names), `x` … `left`.
std::string encodeForcesNpz(const Trajectory& trajectory, double every);

}  // namespace careen
