#pragma once

#include <span>
#include <vector>

#include "physics/world/forces.h"
#include "physics/world/run_settings.h"
#include "physics/world/world.h"

namespace careen {

/// [J]
struct Energy {
  double kinetic = 0;        ///< Σ ½ M v² + ½ ω·L
  double gravitational = 0;  ///< Σ −M g·x, zero at the origin
  double springs = 0;        ///< Σ ½ k (length − rest)²
  double total() const { return kinetic + gravitational + springs; }
};
Energy energyOf(const World& world, std::span<const BodyState> states);

/// Whether all its numbers are finite.
bool isFinite(const BodyState& state);

/// Σ M v, [kg m/s].
Vec3 linearMomentum(const World& world, std::span<const BodyState> states);

/// Energy and momentum balance of a run: the values they should have after everything that acted, against the
/// actual ones. Depends on states only, not on the method.
class RunAccount {
 public:
  RunAccount(const World& world, std::span<const BodyState> initial);

  /// The world advanced by h [s] under constant loads.
  void moved(std::span<const BodyState> before, std::span<const BodyState> after, std::span<const Load> loads,
             double h);
  /// An impact dissipated this energy [J], ≤ 0.
  void struck(double energyChange) { accounted_ += energyChange; }
  /// A state of the run, after impacts; deepest penetration of a corner into a wall [m].
  void reached(std::span<const BodyState> states, double deepest);

  RunFigures figures() const;

 private:
  // Deviation of one body's p or L from what forces gave it, and its largest magnitude.
  struct MomentumAccount {
    Vec3 error = Vec3::Zero();
    double largestErrorSquared = 0;
    double largestSquared = 0;
    void add(const Vec3& before, const Vec3& after, const Vec3& given);
    double relative() const;
  };
  struct BodyAccount {
    MomentumAccount linear;
    MomentumAccount angular;
  };

  const World& world_;
  bool dissipates_ = false;
  std::vector<BodyAccount> bodies_;
  double initialEnergy_ = 0;
  double accounted_ = 0;
  double largestEnergyError_ = 0;
  // Kinetic plus spring energy, independent of gravity's arbitrary zero, less the error: a method that
  // creates energy must not be measured relative to that energy.
  double largestDueEnergy_ = 0;
  double orthogonality_ = 0;
  double deepest_ = 0;
};

}  // namespace careen
