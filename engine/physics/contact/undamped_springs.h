#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "physics/contact/contact_system.h"

namespace careen {

/// Bodies of an island that springs without damping pull, while nothing else takes energy: no contact pushes
/// and there is no drag. Each step of an integrator is wrong by less than its tolerance, but in energy always
/// to the same side, so that over thousands of periods little of an oscillation is left. Here energy,
/// momenta and the spin of bodies without torque are put back after each step.
///
/// Energy is restored along its gradient: velocities about the group's rigid motion, which hold no momentum,
/// are scaled by 1 − α, and bodies are displaced by α τ² M⁻¹ F, so that the denominator of
///
///   α = (E − E₀) / (2 T + τ² F·M⁻¹F)
///
/// does not vanish where an oscillation turns. 1/τ² = Σ k/m over the springs, which no frequency squared
/// exceeds. E₀ is the energy with which the island began, so that nothing adds up.
class UndampedSprings {
 public:
  UndampedSprings(const World& world, std::span<const TouchingBody> bodies);

  bool empty() const { return groups_.empty(); }
  /// The energies of the state y, see ContactSystem, are to be kept from now on, unless they are already.
  void begin(std::span<const double> y);
  /// They need not be any more: a contact pushes.
  void end() { begun_ = false; }
  /// Puts energies and momenta back, `h` [s] after `before`. Returns false if there is nothing to keep.
  bool keep(std::span<const double> before, double h, std::vector<double>& y);

 private:
  struct Member {
    std::size_t at = 0;     // of its numbers in y
    std::size_t index = 0;  // in the world
    const Body* body = nullptr;
    MassProperties mass = {};    // a point's, if it does not turn
    bool turns = false;          // some spring has a torque
    Vec3 origin = Vec3::Zero();  // [m] that its weight's energy counts from
    double energy = 0;           // [J] of its spin, where the island began
  };
  struct Group {
    std::vector<Member> members;
    std::vector<std::size_t> springs;
    bool free = true;   // joined to nothing that cannot move
    double energy = 0;  // [J] E₀
    double period = 0;  // [s²] τ²
  };
  struct Motions;  // about the rigid motion

  BodyState stateOf(const Member& member, std::span<const double> y) const;
  GroupMomentum momentumOfGroup(const Group& group, std::span<const double> y) const;
  Motions motionsOf(const Group& group, std::span<const double> y);
  static void keepSpin(const Member& member, const Vec3& kept, std::vector<double>& y);
  void keepMomenta(const Group& group, std::span<const double> before, double h,
                   std::vector<double>& y) const;
  bool keepEnergy(const Group& group, std::vector<double>& y);

  const World& world_;
  std::vector<BodyState> states_;  // of the world's bodies, those of a group up to date
  std::vector<Group> groups_;
  bool begun_ = false;
};

}  // namespace careen
