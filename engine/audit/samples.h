#pragma once

#include <cstddef>
#include <stop_token>
#include <vector>

#include "physics/world/body.h"
#include "trajectory/trajectory.h"

namespace careen {

/// The states of all bodies at some moments of a run.
class Samples {
 public:
  /// `times` [s] ascend, within the run. Throws Interrupted.
  Samples(const Trajectory& run, std::vector<double> times, const std::stop_token& stop = {});

  const std::vector<double>& times() const { return times_; }
  std::size_t moments() const { return times_.size(); }
  const BodyState& state(std::size_t moment, std::size_t body) const {
    return states_[moment * bodies_ + body];
  }

 private:
  std::size_t bodies_;
  std::vector<double> times_;
  std::vector<BodyState> states_;
};

/// [m] Centre of mass `elapsed` [s] into a motion: the cheap part of stateAt.
Vec3 centerAt(const Motion& motion, double elapsed);

/// Index of the segment that holds at `time` [s]: where two meet, the later one.
std::size_t segmentAt(const Track& track, double time);

/// Whether all numbers of a motion are finite: only then does it have states.
bool isFinite(const Motion& motion);

/// Whether forces of contact may act: the body rests or is moved by contact steps.
bool mayTouch(const Motion& motion);

/// [s] By body: since when it is, or was, a member of a crowd; infinite: never. In a run that comes from a
/// table all bodies count as such from the beginning: what happens between two rows is not known.
std::vector<double> crowdBeginnings(const Trajectory& run);

}  // namespace careen
