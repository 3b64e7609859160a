#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "trajectory/trajectory.h"

namespace careen {

/// Columns of a table of joints, after its time and the joint's name: of hinges in rad and N m, of sliders in
/// m and N.
inline constexpr std::array<std::string_view, 3> kJointColumns = {"coordinate", "rate", "effort"};

/// Hinges and sliders at moments of a run.
class JointSamples {
 public:
  using Row = std::array<double, kJointColumns.size()>;

  explicit JointSamples(const Trajectory& run);

  /// Those that it has, by index in the world.
  const std::vector<std::size_t>& joints() const { return joints_; }
  /// A row for each of them, at a time [s] no earlier than the last. Turns of a hinge are counted from row to
  /// row, between which it turns by less than half a turn. The effort is that of its motor; after a joint has
  /// let go, its coordinate is that of the two bodies all the same.
  std::vector<Row> at(double time);

 private:
  const Trajectory& run_;
  std::vector<std::size_t> joints_;
  std::vector<double> coordinates_;  // at the last row, by joint of the world
  std::vector<double> efforts_;      // likewise
  std::size_t next_ = 0;             // of the run's efforts
  std::vector<BodyState> states_;    // of the world
};

}  // namespace careen
