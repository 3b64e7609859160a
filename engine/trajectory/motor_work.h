#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "trajectory/trajectory.h"

namespace careen {

/// Work of the motors of some joints during a run, from the efforts that it recorded and the coordinates that
/// its poses give: an effort is constant until the next one, so its work is that times the way. Drives count
/// with all their effort, as they give no more, or not at all.
class MotorWork {
 public:
  enum class Drives { kAtMost, kNone };
  MotorWork(const Trajectory& run, std::span<const std::size_t> joints, Drives drives = Drives::kAtMost);

  /// [J] Since it was last asked, or the start. Times [s] may not decrease. A hinge is looked at where its
  /// bodies' segments begin, too: in none of these it turns by half a turn.
  double until(double time);

 private:
  struct Motor {
    const Joint* joint = nullptr;
    double effort = 0;      // [N m] or [N]
    double coordinate = 0;  // where it was last looked at
    double since = 0;       // [s] when
  };
  double ownEffort(const Joint& joint) const {
    return drives_ == Drives::kAtMost ? joint.drive() : joint.effort;
  }
  double coordinateAt(const Joint& joint, double time) const;
  double moveTo(Motor& motor, double time) const;
  double move(Motor& motor, double time) const;

  const Trajectory& run_;
  Drives drives_;
  std::vector<Motor> motors_;
  std::size_t next_ = 0;  // of the run's efforts
};

}  // namespace careen
