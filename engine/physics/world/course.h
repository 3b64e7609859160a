#pragma once

#include <limits>
#include <vector>

#include "core/math/linear_algebra.h"
#include "core/math/pose.h"
#include "physics/world/kinematics.h"

namespace careen {

/// How something held moves by itself, smoothly and in closed form: a point of it, the pivot, goes straight
/// on and swings to and fro, and it turns about that by an angle that grows evenly and swings as well. After
/// s [s], with c = sin(rate s + phase),
///     pivot + velocity s + amplitude c,   turned by the vector spin s + swing c.
struct Driven {
  Vec3 pivot = Vec3::Zero();              ///< [m] world, at its start, but for the swinging
  Vec3 arm = Vec3::Zero();                ///< [m] world, from there to the origin of the body, likewise
  Mat3 worldFromBody = Mat3::Identity();  ///< likewise
  Vec3 velocity = Vec3::Zero();           ///< [m/s]
  Vec3 spin = Vec3::Zero();               ///< [rad/s]
  Vec3 amplitude = Vec3::Zero();          ///< [m]
  Vec3 swing = Vec3::Zero();              ///< [rad] along the spin, if there is one
  double rate = 0;                        ///< [rad/s]
  double phase = 0;                       ///< [rad]

  bool moves() const { return !velocity.isZero(0) || !spin.isZero(0) || swings(); }
  bool swings() const { return rate != 0 && (!amplitude.isZero(0) || !swing.isZero(0)); }
  Kinematics at(double elapsed) const;
  /// The same motion, from `elapsed` [s] on.
  Driven after(double elapsed) const;
  bool operator==(const Driven&) const = default;
};

/// Upper bounds on how something moves.
struct MotionRates {
  double speed = 0;                ///< [m/s] of its origin
  double acceleration = 0;         ///< [m/s²] likewise
  double angularSpeed = 0;         ///< [rad/s]
  double angularAcceleration = 0;  ///< [rad/s²]
};
MotionRates boundsOf(const Driven& driven);

/// What it does from a moment [s] on.
struct CoursePart {
  double from = 0;
  Driven motion;

  Kinematics at(double time) const { return motion.at(time - from); }
  bool operator==(const CoursePart&) const = default;
};

/// All that something held does in a run: parts whose moments ascend, the first of them 0. None: it is still.
using Course = std::vector<CoursePart>;
/// The part at a moment [s]; where two meet, the later one.
const CoursePart& partAt(const Course& course, double time);
/// [s] When the first part after that moment begins; infinite if there is none.
double nextPart(const Course& course, double time);

/// A point [m] that something passes at a time [s].
struct PathPoint {
  double time = 0;
  Vec3 place = Vec3::Zero();
};

/// What a scene says of such a motion. All of it adds up.
struct PrescribedMotion {
  /// Straight from point to point; still before the first and after the last. Only their differences count.
  std::vector<PathPoint> path;
  Vec3 velocity = Vec3::Zero();
  Vec3 angularVelocity = Vec3::Zero();
  Vec3 about = Vec3::Zero();      ///< [m] what it turns about; goes along with path and velocity
  Vec3 amplitude = Vec3::Zero();  ///< [m]
  Vec3 swing = Vec3::Zero();      ///< [rad] along the angular velocity, if there is one
  double rate = 0;                ///< [rad/s]
  double phase = 0;               ///< [rad]
};
/// Of what is at that pose at the start, but for its swinging.
Course courseOf(const PrescribedMotion& motion, const Pose& home);

}  // namespace careen
