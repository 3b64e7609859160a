#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "physics/motion/recorder.h"
#include "physics/world/world.h"

namespace careen {

/// Keeps of a run only where every body is at given moments, however long the run.
class SampledStates : public Recorder {
 public:
  /// `times` [s] ascend; both must outlive this.
  SampledStates(const World& world, std::span<const double> times);

  void moves(BodyIndex body, double time, const Motion& motion) override;
  void strikes(const Impact& /*impact*/) override {}

  /// states[moment][body], once the run has ended.
  std::vector<std::vector<BodyState>> finish();

 private:
  struct Track {
    double start = 0;  // [s]
    Motion motion;
    std::size_t sampled = 0;  // moments known so far
  };
  void sampleBefore(std::size_t body, double time);

  const World& world_;
  std::span<const double> times_;
  std::vector<Track> tracks_;
  std::vector<std::vector<BodyState>> states_;
};

}  // namespace careen
