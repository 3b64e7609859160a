#pragma once

#include <cstddef>
#include <span>

#include "physics/motion/recorder.h"
#include "physics/world/world.h"

namespace careen {

/// [m] Half the thickness of the layer in which a corner touches a wall, as in the 1997 sample.
inline constexpr double kTouchingDepth = 0.001;

/// A corner of a body at a wall.
struct CornerAtWall {
  BodyIndex body;
  std::size_t wall = 0;
  Vec3 point = Vec3::Zero();  ///< [m] world
  double gap = 0;             ///< [m]
};

enum class CornerState {
  kClear,
  kColliding,    ///< a corner within kTouchingDepth of a wall moves towards it
  kPenetrating,  ///< a corner lies deeper than kTouchingDepth
};

struct CornerCheck {
  CornerState state = CornerState::kClear;
  CornerAtWall corner;  ///< the first penetrating, else the last colliding one
  double deepest = 0;   ///< [m] ≥ 0, over the corners tested: all unless one penetrates
};

/// Tests all corners against all walls, body by body and wall by wall, as the 1997 sample did: stops at the
/// first penetrating one. Immovable bodies are skipped.
CornerCheck checkCorners(const World& world, std::span<const BodyState> states);

struct ResolvedCorner {
  Impact impact;
  double energyChange = 0;  ///< [J] of the impact, ≤ 0
};
/// Resolves one colliding corner by a frictionless impulse (Fig. 4), the wall being a body of infinite mass.
ResolvedCorner resolveCorner(const World& world, const CornerAtWall& corner, double time,
                             std::span<BodyState> states);

}  // namespace careen
