#pragma once

#include "core/math/linear_algebra.h"
#include "physics/motion/motion.h"
#include "physics/world/partner.h"

namespace careen {

/// Index of a body in the world, where it might be confused with a rank.
struct BodyIndex {
  int value = 0;
};

/// Impact at one contact point of a collision.
struct Impact {
  double time = 0;              ///< [s]
  BodyIndex a;                  ///< the body the normal points to
  Partner b = {};               ///< what it struck, by index in the world
  Vec3 point = Vec3::Zero();    ///< [m] world
  Vec3 normal = Vec3::UnitZ();  ///< [1] from b to a
  /// [m/s] Normal approach speed at the point before the impact; positive: closing. Not above 0 where the
  /// impulse comes through neighbours, or from a jam.
  double approach = 0;
  double impulse = 0;     ///< [N s] along the normal
  double tangential = 0;  ///< [N s] magnitude of the friction impulse
};

/// Impulse that a joint of the world passed on at one moment: what acts on the body of its end `from`; on the
/// other end acts the opposite, at the same point.
struct JointImpulse {
  double time = 0;              ///< [s]
  int joint = 0;                ///< index in the world
  Vec3 point = Vec3::Zero();    ///< [m] world
  Vec3 linear = Vec3::Zero();   ///< [N s]
  Vec3 angular = Vec3::Zero();  ///< [N m s] couple beside it
};

/// The effort of a joint's motor from then on.
struct JointEffort {
  double time = 0;    ///< [s]
  int joint = 0;      ///< index in the world
  double effort = 0;  ///< [N m] or [N], on the joint's `from`
};

/// Receives what a method reports while it runs; the trajectory is a recorder that stores it.
class Recorder {
 public:
  virtual ~Recorder() = default;
  /// The body has this motion from `time` [s] on; times never decrease per body.
  virtual void moves(BodyIndex body, double time, const Motion& motion) = 0;
  /// In order of time.
  virtual void strikes(const Impact& impact) = 0;
  /// Likewise.
  virtual void passes(const JointImpulse& /*impulse*/) {}
  /// Likewise.
  virtual void drives(const JointEffort& /*effort*/) {}
  /// The run has come to this time [s]: told often, and even where nothing is recorded for long. Of bodies
  /// that are followed one after another, the mean.
  virtual void reaches(double /*time*/) {}
  /// Whether the run may end where it is; only method exact asks.
  virtual bool hasEnough() const { return false; }

 protected:
  Recorder() = default;
  Recorder(const Recorder&) = default;
  Recorder& operator=(const Recorder&) = default;
  Recorder(Recorder&&) = default;
  Recorder& operator=(Recorder&&) = default;
};

}  // namespace careen
