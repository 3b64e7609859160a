#pragma once

#include <array>

#include "core/math/linear_algebra.h"
#include "physics/pile/body.h"

namespace careen {

/// Separations of two boxes along the 15 axes of BoxAxis, in a third of its time: edges that are parallel
/// within 1/128 are left out (the faces' axes stand in for them), and so is all care for the last bits. For a
/// pile, where what is lost by it is below the overlap that is allowed.
struct PileAxes {
  Mat3 cosines;   ///< Aᵀ B
  Vec3 apartA;    ///< [m] from b's centre to a's, in a's frame
  Vec3 apartB;    ///< [m] the same in b's
  int face = 0;   ///< 0…5 best of the faces, see BoxAxis
  int edges = 0;  ///< 6 … 14 best of the edges
  double faceSeparation = 0;
  double edgeSeparation = 0;

  /// `last`, if not −1, wins ties within `tie` [m]. Gives up, and returns false, at the first axis that
  /// separates by more than `reach`: `faceSeparation` then is that axis'.
  bool find(const PileBody& a, const PileBody& b, double reach, int last, double tie);
};

}  // namespace careen
