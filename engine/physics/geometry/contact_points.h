#pragma once

#include <array>
#include <cstddef>

#include "core/math/linear_algebra.h"
#include "physics/geometry/box_at.h"
#include "physics/geometry/separation.h"

namespace careen {

/// A contact point of boxes a and b, relative to both: position + arm − position is not arm in floating
/// point.
struct ContactPoint {
  Vec3 armA = Vec3::Zero();    ///< [m] world, from a's centre of mass
  Vec3 armB = Vec3::Zero();    ///< [m] world, from b's
  Vec3 normal = Vec3::Zero();  ///< [1] unit, from b to a
};

/// Contact manifold of one pair: at most the points of two intersecting quadrilaterals.
class ContactPoints {
 public:
  static constexpr std::size_t kMost = 8;

  void add(const ContactPoint& point) { points_[count_++] = point; }
  std::size_t size() const { return count_; }
  bool full() const { return count_ == kMost; }
  const ContactPoint& operator[](std::size_t k) const { return points_[k]; }
  const ContactPoint* begin() const { return points_.data(); }
  const ContactPoint* end() const { return points_.data() + count_; }

 private:
  std::array<ContactPoint, kMost> points_;
  std::size_t count_ = 0;
};

/// Contact manifold of two boxes at an impact. The normal is that of the face axis of largest separation if
/// it is within kSimultaneous of the best axis, else of the two edges. The lowest feature of each box towards
/// the other, within kSimultaneous, is a corner, an edge or a face; their intersection is a corner, a
/// crossing, the ends of a segment, or the corners of a polygon. Points closer together than kSimultaneous
/// are merged.
///
/// Two faces at an angle that separate equally well (boxes that meet edge to parallel edge, exactly
/// cornerwise) define no unique normal: the first axis listed, a's before b's, is taken.
///
/// Points with a gap up to `apart` [m], if more than kSimultaneous, also count as contact.
ContactPoints boxContactPoints(BoxAt a, BoxAt b, double apart = 0);

}  // namespace careen
