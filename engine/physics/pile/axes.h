#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "core/math/linear_algebra.h"
#include "physics/pile/body.h"

namespace careen {

/// Separations of two boxes along the 15 axes of BoxAxis, in a third of its time: edges parallel within 1/128
/// are skipped (face axes stand in for them), and rounding is not controlled to the last bit. For a pile,
/// where the loss is below the allowed penetration.
struct PileAxes {
  Mat3 cosines;   ///< Aᵀ B
  Vec3 apartA;    ///< [m] from b's middle to a's, in a's frame
  Vec3 apartB;    ///< [m] the same in b's
  int face = 0;   ///< 0…5 best face axis, see BoxAxis
  int edges = 0;  ///< 6 … 14 best edge axis
  double faceSeparation = 0;
  double edgeSeparation = std::numeric_limits<double>::lowest();

  /// `last`, if not −1, wins ties within `tie` [m]. Returns false at the first axis that separates by more
  /// than `reach`; `faceSeparation` is then that separation.
  bool find(const PileBox& a, const PileBox& b, double reach, int last, double tie);

  /// [m] The best, after find(); if that returned false, of a few of them.
  double separation() const { return std::max(faceSeparation, edgeSeparation); }
};

/// [m] Along one of the 15 axes, as in BoxAxis; of edges that are parallel, the lowest double. `apart` [m]:
/// from b's middle to a's.
double separationAlong(int axis, const PileBox& a, const PileBox& b, const Vec3& apart);

/// [m] The gap of two boxes or, where one of the 15 axes shows that it is above `least`, a lower bound of it
/// that is, too. `first`, if not −1, is tried first: that costs little where the boxes touch along it.
double gapAboveOfBoxes(double least, int first, const PileBox& a, const PileBox& b);

}  // namespace careen
