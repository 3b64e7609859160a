#pragma once

#include <utility>

#include "core/math/linear_algebra.h"
#include "stage/triangle_mesh.h"

namespace careen {

/// Of a body that fills a closed mesh, at a density of 1 kg/m³.
struct SolidMoments {
  double volume = 0;            ///< [m³]
  Vec3 center = Vec3::Zero();   ///< [m] centre of mass, in the mesh's frame
  Mat3 inertia = Mat3::Zero();  ///< [m⁵] about the centre of mass, along the mesh's axes
};

/// Sums over the triangles of a closed surface, which run anticlockwise seen from outside. The divergence
/// theorem turns each volume integral into one over the surface (B. Mirtich, "Fast and accurate computation
/// of polyhedral mass properties", 1996). Summed here is the same in another form: the signed tetrahedra from
/// a point o to each triangle a, b, c, all from o, D = a·(b×c):
///     ∫ dV = D/6,   ∫ x dV = D/24 (a+b+c),   ∫ x xᵀ dV = D/120 (a aᵀ + b bᵀ + c cᵀ + s sᵀ),   s = a+b+c.
class SolidSums {
 public:
  explicit SolidSums(Vec3 from) : from_(std::move(from)) {}

  void add(const Vec3& a, const Vec3& b, const Vec3& c);
  double volume() const { return volume_; }  ///< [m³] negative if it is inside out
  double size() const { return size_; }      ///< [m³] of the tetrahedra, whatever their sign
  SolidMoments moments() const;

 private:
  Vec3 from_;
  double volume_ = 0;
  double size_ = 0;
  Vec3 first_ = Vec3::Zero();
  Mat3 second_ = Mat3::Zero();
};

/// Exact but for rounding, by SolidSums. Cavities are meshes within, whose triangles face inward.
///
/// InputError names the edge if the mesh is open, or if two of its triangles run along an edge in the same
/// direction: then one is turned over, or more than two meet. InputError too if it is inside out, or encloses
/// nothing. Surfaces that cut themselves elsewhere than at edges are not found.
SolidMoments momentsOf(const TriangleMesh& mesh);

}  // namespace careen
