#pragma once

#include "core/math/linear_algebra.h"
#include "stage/run_setup.h"

namespace careen {

/// A box along the world's axes.
struct Extent {
  Vec3 min = Vec3::Zero();  ///< [m]
  Vec3 max = Vec3::Zero();  ///< [m]

  Vec3 centre() const { return 0.5 * (min + max); }
  double radius() const { return 0.5 * (max - min).norm(); }  ///< [m] of the sphere around it
  /// Bit 2 of the index picks the side of x, bit 1 of y, bit 0 of z; a clear bit is max.
  Vec3 corner(int index) const;
};

/// The part of the world that a run takes place in: its room; without one, what its boxes reach in free
/// flight until they meet a wall, and where its springs are held.
Extent extentOf(const RunSetup& setup);

}  // namespace careen
