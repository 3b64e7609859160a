#pragma once

#include "core/math/linear_algebra.h"
#include "stage/run_setup.h"

namespace careen {

/// An axis-aligned bounding box.
struct Extent {
  Vec3 min = Vec3::Zero();  ///< [m]
  Vec3 max = Vec3::Zero();  ///< [m]

  Vec3 centre() const { return 0.5 * (min + max); }
  double radius() const { return 0.5 * (max - min).norm(); }  ///< [m] of its bounding sphere
  /// Bit 2 of the index selects the side of x, bit 1 of y, bit 0 of z; a clear bit is max.
  Vec3 corner(int index) const;
};

/// The part of the world where a run takes place: its room; without one, what its boxes reach in free flight
/// before they hit a wall, and the fixed ends of its springs.
Extent extentOf(const RunSetup& setup);

}  // namespace careen
