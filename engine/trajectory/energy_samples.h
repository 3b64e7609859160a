#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "trajectory/energy_losses.h"
#include "trajectory/motor_work.h"
#include "trajectory/trajectory.h"

namespace careen {

/// The parts of a run's energy at a moment [J].
struct EnergyShares {
  double translation = 0;   ///< Σ ½ M v²
  double rotation = 0;      ///< Σ ½ ω·L
  double gravity = 0;       ///< Σ −M g·x
  double springs = 0;       ///< Σ ½ k (length − rest)², of the scene's springs
  double jointSprings = 0;  ///< Σ ½ k (q − rest)², of joints that have not let go
  double sum() const { return translation + rotation + gravity + springs + jointSprings; }
};
/// `states`: one for each body, at that time [s].
EnergyShares energySharesOf(const World& world, std::span<const BodyState> states, double time);

/// Energies of a run at a moment, and what was given and lost since its start [J]:
/// shares.sum() − motors − changes + Σ of what was lost is the energy at the start.
struct RunEnergies {
  EnergyShares shares;
  double motors = 0;  ///< work of motors, as controls set their efforts
  /// By which that of gravity changed as gravity did: −M (g′ − g)·x where it jumps, −M ∫ (dg/dt)·x dt where
  /// it slopes.
  double changes = 0;
  EnergyLosses lost;
  /// What remains: lost in contact, by friction and in collisions of time steps, whose velocities do not jump
  /// at one moment; less the work of drives and of surfaces that move, whose forces are not recorded; and
  /// what a joint that lets go takes along.
  double remaining = 0;
  Vec3 momentum = Vec3::Zero();         ///< [kg m/s] Σ M v
  Vec3 angularMomentum = Vec3::Zero();  ///< [kg m²/s] about the world's origin
};

/// Columns of a table of energies, after its time.
struct EnergyColumn {
  std::string_view name;
  std::string_view unit;
  double (*of)(const RunEnergies& energies);
};
inline constexpr std::array<EnergyColumn, 19> kEnergyColumns = {
    {{"translation", "J", [](const RunEnergies& e) { return e.shares.translation; }},
     {"rotation", "J", [](const RunEnergies& e) { return e.shares.rotation; }},
     {"gravity", "J", [](const RunEnergies& e) { return e.shares.gravity; }},
     {"springs", "J", [](const RunEnergies& e) { return e.shares.springs; }},
     {"joint_springs", "J", [](const RunEnergies& e) { return e.shares.jointSprings; }},
     {"total", "J", [](const RunEnergies& e) { return e.shares.sum(); }},
     {"motors", "J", [](const RunEnergies& e) { return e.motors; }},
     {"changes", "J", [](const RunEnergies& e) { return e.changes; }},
     {"impacts", "J", [](const RunEnergies& e) { return e.lost.impacts; }},
     {"joint_friction", "J", [](const RunEnergies& e) { return e.lost.jointFriction; }},
     {"damping", "J", [](const RunEnergies& e) { return e.lost.damping; }},
     {"drag", "J", [](const RunEnergies& e) { return e.lost.drag; }},
     {"remaining", "J", [](const RunEnergies& e) { return e.remaining; }},
     {"px", "kg m/s", [](const RunEnergies& e) { return e.momentum.x(); }},
     {"py", "kg m/s", [](const RunEnergies& e) { return e.momentum.y(); }},
     {"pz", "kg m/s", [](const RunEnergies& e) { return e.momentum.z(); }},
     {"lx", "kg m^2/s", [](const RunEnergies& e) { return e.angularMomentum.x(); }},
     {"ly", "kg m^2/s", [](const RunEnergies& e) { return e.angularMomentum.y(); }},
     {"lz", "kg m^2/s", [](const RunEnergies& e) { return e.angularMomentum.z(); }}}};

/// Energies at moments of a run.
class EnergySamples {
 public:
  explicit EnergySamples(const Trajectory& run);

  /// At a time [s] no earlier than the last.
  RunEnergies at(double time);

 private:
  double givenBy(std::size_t change) const;
  double givenUntil(double time) const;

  const Trajectory& run_;
  double atStart_ = 0;  // [J]
  MotorWork motorWork_;
  double motors_ = 0;          // [J] until the last time
  double changes_ = 0;         // [J] likewise
  double time_ = 0;            // [s] the last
  std::size_t gravities_ = 0;  // changes of gravity until then
  LossesOfRun losses_;
};

}  // namespace careen
