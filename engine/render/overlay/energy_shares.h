#pragma once

#include <span>
#include <vector>

#include "trajectory/energy_samples.h"
#include "trajectory/trajectory.h"

namespace careen {

/// Energy balance of a run, which it must not outlive. Each box's potential energy is relative to x₀, the
/// lowest position its centre reaches in the run, so that no part is negative: in free flight the minimum is
/// at one of the ends. Where gravity changes, each gravity has its own; where it slopes, x₀ goes
/// evenly from one to the next.
class EnergyBook {
 public:
  explicit EnergyBook(const Trajectory& trajectory);

  /// `states`: one for each box, at that time [s].
  EnergyShares sharesOf(std::span<const BodyState> states, double time) const;
  double atStart() const { return atStart_; }
  /// The largest sum found: close to that at the start unless numerical errors add energy.
  double largest() const { return largest_; }
  bool hasSprings() const { return hasSprings_; }

 private:
  const World& world_;
  std::vector<double> lowest_;  // [J] by gravity: Σ M · minimum of −g·x
  bool hasSprings_ = false;
  double atStart_ = 0;
  double largest_ = 0;
};

}  // namespace careen
