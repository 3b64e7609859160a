#pragma once

#include <span>
#include <vector>

#include "trajectory/trajectory.h"

namespace careen {

/// The parts of a run's energy at a moment [J].
struct EnergyShares {
  double translation = 0;  ///< Σ ½ M v²
  double rotation = 0;     ///< Σ ½ ω·L
  double potential = 0;    ///< Σ −M g·(x − x₀), see EnergyBook
  double springs = 0;      ///< Σ ½ k (length − rest)²
  double sum() const { return translation + rotation + potential + springs; }
};

/// Energy balance of a run. Each box's potential energy is relative to x₀, the lowest position its centre
/// reaches in the run, so that no part is negative: in free flight the minimum is at one of the ends.
class EnergyBook {
 public:
  explicit EnergyBook(const Trajectory& trajectory);

  /// `states`: one for each box, at the same moment.
  EnergyShares sharesOf(std::span<const BodyState> states) const;
  double atStart() const { return atStart_; }
  /// The largest sum found: close to that at the start unless numerical errors add energy.
  double largest() const { return largest_; }
  bool hasSprings() const { return !springs_.empty(); }

 private:
  Vec3 gravity_;
  std::vector<Spring> springs_;
  std::vector<MassProperties> masses_;
  std::vector<double> lowest_;  // [J/kg] minimum of −g·x of each box
  double atStart_ = 0;
  double largest_ = 0;
};

/// One state for each box, at a time within the run [s].
std::vector<BodyState> statesAt(const Trajectory& trajectory, double time);

}  // namespace careen
