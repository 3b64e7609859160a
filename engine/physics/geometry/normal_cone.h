#pragma once

#include <array>
#include <cstddef>

#include "core/math/linear_algebra.h"

namespace careen {

/// Directions that separate two touching boxes: unit n with n·p ≥ 0 for every bound p. Bounds are the inward
/// normals of a's faces at the contact and the outward normals of b's, so the cone is the intersection of a's
/// normal cone, reversed, with b's. It is one ray where a face touches or edges cross, a fan for parallel
/// edges or a corner on an edge, solid for two corners.
class NormalCone {
 public:
  static constexpr std::size_t kMost = 6;  ///< three faces at a corner of each

  /// Unit bounds, all in one plane for a fan.
  void add(const Vec3& bound) { bounds_[count_++] = bound; }

  struct Centre {
    Vec3 direction = Vec3::Zero();  ///< [1] unit
    double margin = -1;             ///< [1] sine of its angle to the nearest side of the cone
  };
  /// The direction of the cone with the largest margin: a fan's bisector, the axis of the largest round cone
  /// inside a solid one. Unique, so mirror images, rotations and swapped boxes give mirrored, rotated and
  /// reversed directions. Found in extended precision: bounds that agree to rounding, usual in symmetric
  /// scenes, change no more than the last bit, and their order practically none.
  Centre centre() const;

 private:
  std::array<Vec3, kMost> bounds_;
  std::size_t count_ = 0;
};

}  // namespace careen
