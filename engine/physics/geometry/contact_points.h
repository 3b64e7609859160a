#pragma once

#include <array>
#include <cstddef>

#include "core/math/linear_algebra.h"
#include "core/math/pose.h"
#include "physics/geometry/separation.h"

namespace careen {

/// A point where box a touches box b, seen from both: position + arm − position is not arm in floating point.
struct ContactPoint {
  Vec3 armA = Vec3::Zero();    ///< [m] world, from a's centre of mass
  Vec3 armB = Vec3::Zero();    ///< [m] world, from b's
  Vec3 normal = Vec3::Zero();  ///< [1] unit, from b to a
};

/// The points of one pair's contact, at most those of two quadrilaterals laid on each other.
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

/// At the moment of an impact: where two boxes touch. The normal is that of the face that separates best if
/// it does so within kSimultaneous of the best direction, else of the two edges. Each box's lowest feature
/// towards the other, within kSimultaneous, is a corner, an edge or a face; their common part is a corner, a
/// crossing, the ends of a segment, or the corners of a polygon. Points nearer to each other than
/// kSimultaneous are one.
///
/// Two faces at an angle that separate equally well (boxes that meet edge to parallel edge, exactly
/// cornerwise) have no normal of their own: the one listed first, a's before b's, is taken.
///
/// With `apart` [m] instead of kSimultaneous, where that is more: points that so little parts are contact
/// too.
ContactPoints boxContactPoints(const Pose& a, const Vec3& halfExtentsA, const Pose& b,
                               const Vec3& halfExtentsB, double apart = 0);

}  // namespace careen
