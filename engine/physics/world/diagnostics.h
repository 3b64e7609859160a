#pragma once

#include <span>
#include <vector>

#include "physics/world/forces.h"
#include "physics/world/method.h"
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

/// Whether every number of it is finite.
bool isFinite(const BodyState& state);

/// Σ M v, [kg m/s].
Vec3 linearMomentum(const World& world, std::span<const BodyState> states);

/// Keeps a run's account: what its energy and momentum should be after everything that acted, against what
/// they are. It looks at states only, never at how a method came by them.
class RunAccount {
 public:
  RunAccount(const World& world, std::span<const BodyState> initial);

  /// The world moved on by h [s] under loads taken as constant.
  void moved(std::span<const BodyState> before, std::span<const BodyState> after, std::span<const Load> loads,
             double h);
  /// An impact took this energy out [J], ≤ 0.
  void struck(double energyChange) { accounted_ += energyChange; }
  /// A state of the run, impacts included; its deepest corner behind a wall [m].
  void reached(std::span<const BodyState> states, double deepest);

  RunFigures figures() const;

 private:
  // How far one body's p or L has strayed from what forces gave it, and the largest it was.
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
  // Kinetic plus springs, which gravity's arbitrary zero does not touch, less the error: a method that makes
  // energy is not to be measured by what it made.
  double largestDueEnergy_ = 0;
  double orthogonality_ = 0;
  double deepest_ = 0;
};

}  // namespace careen
