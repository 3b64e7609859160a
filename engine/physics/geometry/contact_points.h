#pragma once

#include <array>
#include <cstddef>

#include "core/math/linear_algebra.h"
#include "physics/geometry/box_at.h"
#include "physics/geometry/separating_axes.h"

namespace careen {

/// A contact point of boxes a and b, relative to both: position + arm − position is not arm in floating
/// point.
struct ContactPoint {
  Vec3 armA = Vec3::Zero();    ///< [m] world, from a's centre of mass
  Vec3 armB = Vec3::Zero();    ///< [m] world, from b's
  Vec3 normal = Vec3::Zero();  ///< [1] unit, from b to a
  bool inCone = false;         ///< the normal is the centre of a cone, see below
};

/// The same with a and b in each other's place.
ContactPoint swapped(const ContactPoint& point);

/// Contact manifold of one pair: at most the points of two intersecting quadrilaterals.
class ContactPoints {
 public:
  static constexpr std::size_t kMost = 8;

  void add(const ContactPoint& point) { points_[count_++] = point; }
  std::size_t size() const { return count_; }
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
/// Edge along parallel edge, corner on edge (or edge over an edge's end), corner on corner: where neither
/// part is a face and no edges cross, a cone of directions separates the boxes equally well, and the gap has
/// no unique normal. While one of them keeps the boxes apart nothing acts (separatingAxes). Where none does,
/// the normal is the centre of that cone (NormalCone), for parallel edges the bisector of its fan. It is the
/// normal of two slightly rounded boxes, and symmetric where they are: head on along a line through both
/// centres it is that line. It holds where the axes of largest separation agree within the tolerance that
/// makes contacts simultaneous (touchingWithin) and their normals differ by more than it can turn the thinner
/// box; beside that, a contact is one of the former. The points lie halfway between the two edges or corners.
/// Mirror images, quarter turns about coordinate axes and swapped boxes give mirrored, turned and reversed
/// normals.
///
/// Points with a gap up to `apart` [m], if more than kSimultaneous, also count as contact. If not all axes
/// are given, the normal is that of one of them, of a face if there is one.
ContactPoints boxContactPoints(const BoxAt& a, const BoxAt& b, double apart = 0, AxisSet among = kAllAxes);

}  // namespace careen
