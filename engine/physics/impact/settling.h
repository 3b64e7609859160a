#pragma once

#include <span>

#include "core/math/linear_algebra.h"

namespace careen {

/// Bounces that accumulate. A body that leaves a wall with normal speed v₊ > 0 under a constant normal
/// acceleration a_n < 0 comes back after 2 v₊/|a_n|, each further hop e times the last: a geometric series
/// that ends.
struct Bouncing {
  double acceleration = 0;  ///< [m/s²] a_n, along the wall's normal; settles only where negative
  double departure = 0;     ///< [m/s] v₊ ≥ 0, normal speed after the impact
  double restitution = 0;   ///< [1] e < 1
  double gapRounding = 0;   ///< [m] of the gap to the wall
};

/// 2 v₊/|a_n| [s]: how long the hop that now begins will last. Infinite without acceleration towards the
/// wall.
double nextHop(const Bouncing& bouncing);
/// 2 v₊/(|a_n|(1−e)) [s]: how long all hops together will last. Infinite for e = 1.
double settlingTail(const Bouncing& bouncing);
/// v₊²/(2|a_n|) [m]: the height given up by replacing the hops by rest.
double nextHeight(const Bouncing& bouncing);

/// Hops shorter than τ [s] are not followed one by one. τ is kSettlingFraction of the time in which the body
/// would fall its own smallest half extent, sqrt(2 h/|a_n|): taken from the scene's own scales, so that
/// lengths × 4 with times × 2 gives the same bits, and so that the height given up, |a_n| τ²/8 = h
/// kSettlingFraction²/4 at most, is 2e-13 of the box. The tail's time is exact whatever τ is.
double settlingHop(const Bouncing& bouncing, double smallestHalfExtent);
inline constexpr double kSettlingFraction = 0x1p-20;
inline constexpr double kRoundingsOfAHop = 16;

/// True when the remaining bounces are to be summed instead of followed: shorter than τ, or so low that the
/// gap's rounding feeds them. A hop that ends δ lower than it began gains 2|a_n|δ of squared speed, so hops
/// of height e²δ/(1−e²) would go on for ever; a thin plate comes to that long before its τ. The search ends a
/// hop within a few roundings: kRoundingsOfAHop of them, over 1−e², leave a margin.
bool settles(const Bouncing& bouncing, double smallestHalfExtent);

/// What becomes of a body when its bounces have ended.
enum class Settled {
  kRests,      ///< stands on the contacts given, nothing moves
  kSlides,     ///< still has a tangential velocity
  kSlipsDown,  ///< at rest, but tangential gravity exceeds friction: tan θ > μ
  kRocks,      ///< still turns, or what carries it is not below its centre of mass
};

/// A body that has just lost its normal speed. Velocities are those after the impact, settled normal speed
/// removed.
struct Settling {
  Vec3 velocity = Vec3::Zero();         ///< [m/s]
  Vec3 angularVelocity = Vec3::Zero();  ///< [rad/s]
  Vec3 normal = Vec3::UnitZ();          ///< [1] unit, of the wall
  Vec3 gravity = Vec3::Zero();          ///< [m/s²]
  std::span<const Vec3> arms;           ///< [m] from the centre of mass to the points that touch
  double friction = 0;                  ///< [1] μ
  double speed = 0;  ///< [m/s] of the last impact: what `velocity` is compared with, within rounding
};

/// Rests only if it really would: no velocity left but rounding error, carried by three points or more around
/// the line of gravity through its centre of mass, steep no more than friction holds.
Settled afterTail(const Settling& settling);

/// Relative size below which a velocity is rounding error, and slack of the comparisons of lengths and
/// slopes.
inline constexpr double kSettlingRounding = 0x1p-40;

}  // namespace careen
