#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "physics/motion/recorder.h"
#include "physics/world/world.h"

namespace careen {

/// Records only the states at given times, however long the run.
class SampledStates : public Recorder {
 public:
  /// `times` [s] ascend; both arguments must outlive this object.
  SampledStates(const World& world, std::span<const double> times);

  void moves(BodyIndex body, double time, const Motion& motion) override;
  void strikes(const Impact& /*impact*/) override {}

  /// states[time][body], after the end of the run.
  std::vector<std::vector<BodyState>> finish();

 private:
  struct Track {
    double start = 0;  // [s]
    Motion motion;
    std::size_t sampled = 0;  // number of times sampled so far
  };
  void sampleBefore(std::size_t body, double time);

  const World& world_;
  std::span<const double> times_;
  std::vector<Track> tracks_;
  std::vector<std::vector<BodyState>> states_;
};

}  // namespace careen
