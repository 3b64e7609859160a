#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <vector>

#include "render/draw/drawn_box.h"
#include "render/gl/vertex_array.h"

namespace careen {

/// What casts shadows, seen along the light. `towards` is a unit vector to the light; (across, along,
/// towards) is a right-handed frame, "depth" the coordinate towards the light.
class LightPlane {
 public:
  /// A box: its bounds in that frame.
  struct Bounds {
    Vec3 min = Vec3::Zero();
    Vec3 max = Vec3::Zero();
  };

  LightPlane(const Vec3& towards, std::span<const DrawnBox> boxes);

  const Vec3& towards() const { return towards_; }
  Vec3 seen(const Vec3& point) const { return lightFromWorld_ * point; }
  const Bounds& bounds(std::size_t box) const { return bounds_[box]; }
  /// Boxes that may lie over this part of the plane, each once; `least` and `most` in its frame.
  void gather(const Vec3& least, const Vec3& most, std::vector<std::size_t>& found);

 private:
  std::array<int, 2> cellOf(const Vec3& seen) const;

  Vec3 towards_;
  Mat3 lightFromWorld_;
  std::vector<Bounds> bounds_;
  Vec3 origin_ = Vec3::Zero();
  double cell_ = 1;  // [m]
  int cells_ = 1;    // in each direction
  std::vector<std::vector<std::size_t>> content_;
  std::size_t search_ = 0;
  std::vector<std::size_t> foundBy_;  // of each box, the last search that found it
};

/// A box seen along the light, the part where |slab·q| <= half for three slabs, q the offset from the box's
/// centre; and by each axis of the box, how far along the light a ray from q is in the middle of the box, and
/// from there to where it enters or leaves it.
struct Zonogon {
  Vec3 centre = Vec3::Zero();       ///< [m] of the box, world
  Mat3 slabs = Mat3::Zero();        ///< rows: unit normals perpendicular to the light; 0 for an axis along it
  Vec3 half = Vec3::Zero();         ///< [m]
  Mat3 passing = Mat3::Zero();      ///< rows: the middle is at passing·q [m]
  Vec3 halfPassing = Vec3::Zero();  ///< [m]
};
Zonogon zonogonOf(const DrawnBox& box, const Vec3& towards);

/// Appends what shadow.vert reads of a vertex: 16 floats. `offset` is the point minus the eye, in the single
/// precision that it is drawn with; `weight` the part of the light that is kept off at most.
void appendShadow(std::vector<float>& records, const Zonogon& zonogon, const Vec3& point,
                  const std::array<float, 3>& offset, double weight);
inline constexpr std::initializer_list<Attribute> kShadowAttributes = {{0, 3}, {1, 3}, {2, 3},
                                                                       {3, 3}, {4, 3}, {5, 1}};

}  // namespace careen
