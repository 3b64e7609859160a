#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "trajectory/trajectory.h"

namespace careen {

/// What a run lost by causes that its record tells apart [J].
struct EnergyLosses {
  double impacts = 0;        ///< jumps of kinetic energy where impacts and joints' impulses are recorded
  double jointFriction = 0;  ///< dry friction of joints
  double damping = 0;        ///< of springs and joints
  double drag = 0;
  double sum() const { return impacts + jointFriction + damping + drag; }
};

/// Follows a run from its start. Losses between impacts are integrals of powers over its motions, by a rule
/// that is exact for polynomials of degree 9: of the squared speed in a step of contact, which has degree 8.
class LossesOfRun {
 public:
  explicit LossesOfRun(const Trajectory& run);

  /// Since the start, until a time [s] no earlier than the last.
  EnergyLosses until(double time);

 private:
  /// Something that takes energy all the time.
  struct Taker {
    std::array<std::optional<int>, 2> bodies;  // whose motions it depends on
    double EnergyLosses::*kind = nullptr;
    std::function<double(std::span<const BodyState>)> power;  // [W]
    double end = Joint::kFree;                                // [s] of its effect
    double since = 0;                                         // [s] until when its loss is known
  };
  void addTakers();
  void follow(Taker& taker, double time);
  double integral(const Taker& taker, double from, double to);
  void strike(double time);

  const Trajectory& run_;
  std::vector<Taker> takers_;
  std::vector<BodyState> states_;  // of the world, those of a taker up to date
  std::size_t nextImpact_ = 0;
  std::size_t nextPassed_ = 0;
  EnergyLosses lost_;
};

}  // namespace careen
