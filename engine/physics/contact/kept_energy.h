#pragma once

#include <optional>
#include <span>
#include <vector>

#include "physics/contact/contact_system.h"

namespace careen {

/// Energy of bodies that only joints hold, and nothing takes or gives any: no contact pushes, no drag, damper
/// or motor acts, and gravity is constant. Each step's error changes it a little, and over many swings that
/// is what moves a pendulum off its place in time. Scaling the velocities about the group's rigid motion puts
/// it right, and no joint notices: its rates are linear in them. (E. Hairer, Ch. Lubich, G. Wanner,
/// "Geometric Numerical Integration", IV.4: projection on invariants.)
class KeptEnergy {
 public:
  /// Both must outlive it.
  KeptEnergy(const World& world, const ContactSystem& system) : world_(world), system_(system) {}

  /// Steps begin at that state, or go on; what they have is kept from the first of them on.
  void begin(std::span<const double> y);
  void end() { due_.reset(); }
  /// Returns whether it changed velocities: not where hardly anything moves.
  bool keep(std::vector<double>& y) const;

 private:
  struct Energy {
    double total = 0;     // [J]
    double largest = 0;   // [J] of its parts
    double relative = 0;  // [J] kinetic, of motion relative to the rigid one
    GroupMomentum rigid;  // of those that nothing holds in the world; else at rest
    Vec3 turning = Vec3::Zero();
  };
  bool isConstant() const;
  bool isFree() const;
  Energy energyOf(std::span<const double> y) const;

  const World& world_;
  const ContactSystem& system_;
  std::vector<Vec3> origins_;  // [m] by body: heights count from there
  std::optional<double> due_;  // [J]
};

}  // namespace careen
