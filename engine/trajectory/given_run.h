#pragma once

#include <span>
#include <vector>

#include "trajectory/pose_table.h"
#include "trajectory/trajectory.h"

namespace careen {

/// The run that a table of poses describes, of the boxes of this setup: their sizes, masses and names, and
/// the walls, are the setup's. It has the table's poses at the table's times bit for bit (quaternions
/// normalised), and lasts until the first of the boxes has no more rows. If a box has no row at 0 s, its
/// state there is the setup's. Velocities that the table lacks are estimated, see estimatedRates().
///
/// InputError, naming file and row, if the table has another box than the setup or lacks one that can move,
/// if a fixed box is elsewhere, or if there is nothing after 0 s.
Trajectory givenRun(RunSetup setup, const PoseTable& table);

/// Rates at the times of samples [s], from parabolas through three neighbouring values each: exact for a
/// parabola, such as free fall, with an error of second order in the distance of the samples else. Of the
/// three parabolas the middle one, unless another has less than half its curvature: that one does not cross
/// an impact (essentially non-oscillatory interpolation, A. Harten and others, J. Comput. Phys. 71, 1987).
/// One rate of 0 for one sample.
std::vector<Vec3> estimatedRates(std::span<const double> times, std::span<const Vec3> values);

/// Angular velocities [rad/s], world frame, likewise; any signs of the unit quaternions. A box must turn by
/// less than half a turn between two samples.
std::vector<Vec3> estimatedAngularVelocities(std::span<const double> times, std::span<const Quat> attitudes);

}  // namespace careen
