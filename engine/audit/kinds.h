#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace careen {

/// What an audit can find wrong with a run.
enum class AuditKind : int {
  kNotFinite,
  kBoxOverlap,
  kWallOverlap,
  kOrthogonality,
  kContinuity,
  kImpulse,
  kLinearMomentum,
  kAngularMomentum,
  kEnergyRise,
  kEnergyLoss,
  kRestitution,
  kFriction,
  kJointGap,
  kJointLimit
};

struct AuditKindTraits {
  AuditKind kind;
  std::string_view name;  ///< as report.json spells it
  std::string_view unit;  ///< of its size
  std::string_view what;  ///< for messages
};

inline constexpr std::array kAuditKinds = {
    AuditKindTraits{AuditKind::kNotFinite, "not_finite", "states", "states that are not finite"},
    AuditKindTraits{AuditKind::kBoxOverlap, "box_overlap", "m", "boxes overlap"},
    AuditKindTraits{AuditKind::kWallOverlap, "wall_overlap", "m", "a box is behind a wall"},
    AuditKindTraits{AuditKind::kOrthogonality, "orthogonality", "1", "|AAᵀ-1|"},
    AuditKindTraits{AuditKind::kContinuity, "continuity", "m", "a box jumps"},
    // The momenta relative to the largest of the bodies that exchange it, the energies to their largest
    // kinetic and spring energy.
    AuditKindTraits{AuditKind::kImpulse, "impulse", "1", "a velocity jumps by more than its impacts give"},
    AuditKindTraits{AuditKind::kLinearMomentum, "linear_momentum", "1", "unexplained linear momentum"},
    AuditKindTraits{AuditKind::kAngularMomentum, "angular_momentum", "1", "unexplained angular momentum"},
    AuditKindTraits{AuditKind::kEnergyRise, "energy_rise", "1", "unexplained energy"},
    AuditKindTraits{AuditKind::kEnergyLoss, "energy_loss", "1", "energy nothing took"},
    // Of tables only. Friction is relative to the body's largest momentum.
    AuditKindTraits{AuditKind::kRestitution, "restitution", "1", "a bounce is not that of the scene"},
    AuditKindTraits{AuditKind::kFriction, "friction", "1", "friction is not that of the scene"},
    AuditKindTraits{AuditKind::kJointGap, "joint_gap", "m", "a joint is open"},
    AuditKindTraits{AuditKind::kJointLimit, "joint_limit", "m", "a joint is beyond its limits"}};
inline constexpr std::size_t kAuditKindCount = kAuditKinds.size();

constexpr std::size_t indexOf(AuditKind kind) { return static_cast<std::size_t>(kind); }
constexpr const AuditKindTraits& traitsOf(AuditKind kind) { return kAuditKinds[indexOf(kind)]; }

}  // namespace careen
