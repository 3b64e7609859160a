#pragma once

#include "core/math/linear_algebra.h"
#include "physics/motion/motion.h"
#include "physics/world/partner.h"

namespace careen {

/// A body by its place in the world, where ranks might be meant.
struct BodyIndex {
  int value = 0;
};

/// One contact point's share of a collision.
struct Impact {
  double time = 0;              ///< [s]
  BodyIndex a;                  ///< the body the normal points to
  Partner b = {};               ///< what it struck, by place in the world
  Vec3 point = Vec3::Zero();    ///< [m] world
  Vec3 normal = Vec3::UnitZ();  ///< [1] from b to a
  double approach = 0;          ///< [m/s] normal speed at the point before; positive: they were closing in
  double impulse = 0;           ///< [N s] along the normal
  double tangential = 0;        ///< [N s] size of the friction part
};

/// What a method tells while it runs; the trajectory is one that remembers.
class Recorder {
 public:
  virtual ~Recorder() = default;
  /// From `time` [s] on the body moves so; times never decrease for one body.
  virtual void moves(BodyIndex body, double time, const Motion& motion) = 0;
  /// In order of time.
  virtual void strikes(const Impact& impact) = 0;

 protected:
  Recorder() = default;
  Recorder(const Recorder&) = default;
  Recorder& operator=(const Recorder&) = default;
  Recorder(Recorder&&) = default;
  Recorder& operator=(Recorder&&) = default;
};

}  // namespace careen
