#pragma once

#include <span>

#include "core/math/linear_algebra.h"

namespace careen {

/// Chattering (Zeno): bounces that accumulate. A body that leaves a wall with normal speed v₊ > 0 under a
/// constant normal acceleration a_n < 0 comes back after 2 v₊/|a_n|, each further hop e times as long as the
/// last: a convergent geometric series.
struct Bouncing {
  double acceleration = 0;  ///< [m/s²] a_n, along the wall's normal; settles only where negative
  double departure = 0;     ///< [m/s] v₊ ≥ 0, normal speed after the impact
  double restitution = 0;   ///< [1] e < 1
  double gapRounding = 0;   ///< [m] of the gap to the wall
};

/// 2 v₊/|a_n| [s]: duration of the hop that begins. Infinite without acceleration towards the wall.
double nextHop(const Bouncing& bouncing);
/// 2 v₊/(|a_n|(1−e)) [s]: duration of all hops together. Infinite for e = 1.
double settlingTail(const Bouncing& bouncing);
/// v₊²/(2|a_n|) [m]: the height lost by replacing the hops by rest.
double nextHeight(const Bouncing& bouncing);

/// Hops shorter than τ [s] are not followed one by one. τ is kSettlingFraction times the time to fall the
/// body's smallest half extent, sqrt(2 h/|a_n|): it scales with the scene, so that lengths × 4 with times × 2
/// gives the same bits, and the height lost, |a_n| τ²/8 = h kSettlingFraction²/4 at most, is 2e-13 of the
/// box. The tail's duration is exact for any τ.
double settlingHop(const Bouncing& bouncing, double smallestHalfExtent);
inline constexpr double kSettlingFraction = 0x1p-20;
inline constexpr double kRoundingsOfAHop = 16;

/// Whether the remaining bounces are summed instead of followed: shorter than τ, or so low that rounding of
/// the gap sustains them. A hop that ends δ lower than it began gains 2|a_n|δ of squared speed, so hops of
/// height e²δ/(1−e²) would go on for ever; a thin plate gets there long before its τ. The search ends a hop
/// within a few roundings: kRoundingsOfAHop of them, over 1−e², leave a margin.
bool settles(const Bouncing& bouncing, double smallestHalfExtent);

/// What becomes of a body when its bounces have ended.
enum class Settled {
  kRests,      ///< at rest on the contacts given
  kSlides,     ///< still has a tangential velocity
  kSlipsDown,  ///< at rest, but tangential gravity exceeds friction: tan θ > μ
  kRocks,      ///< still rotates, or its support is not below its centre of mass
};

/// A body that has just lost its normal speed. Velocities are those after the impact, settled normal speed
/// removed.
struct Settling {
  Vec3 velocity = Vec3::Zero();         ///< [m/s]
  Vec3 angularVelocity = Vec3::Zero();  ///< [rad/s]
  Vec3 normal = Vec3::UnitZ();          ///< [1] unit, of the wall
  Vec3 gravity = Vec3::Zero();          ///< [m/s²]
  std::span<const Vec3> arms;           ///< [m] from the centre of mass to the contact points
  double friction = 0;                  ///< [1] μ
  double speed = 0;  ///< [m/s] of the last impact: scale for the rounding error of `velocity`
};

/// The body rests only if its velocity is rounding error, three or more points around the line of gravity
/// through its centre of mass support it, and friction holds on the slope.
Settled afterTail(const Settling& settling);

/// Relative size below which a velocity is rounding error, and tolerance when comparing lengths and slopes.
inline constexpr double kSettlingRounding = 0x1p-40;

}  // namespace careen
