#pragma once

#include <array>
#include <vector>

#include "render/draw/drawn_box.h"
#include "stage/triangle_mesh.h"

namespace careen {

/// A triangle turned to the eye, in the terms in which faces of boxes are drawn: the places of its corners
/// from two of its edges, of which the picture smooths the outlines. These are edges of the silhouette as far
/// as it has some, else any.
struct MeshFace {
  std::array<Vec3, 3> corners;                 ///< [m] world
  Vec3 normal = Vec3::UnitZ();                 ///< [1] outward
  std::array<Vec3, 2> outward;                 ///< [1] in the plane, from the triangle across each edge
  std::array<double, 2> height{};              ///< [m] of the corner opposite to each edge, above it
  std::array<std::array<double, 2>, 3> place;  ///< [m] of each corner, along outward from the opposite corner
};

/// The triangles of a mesh at a pose that the eye sees, but for those that other triangles hide.
std::vector<MeshFace> meshFacesTowards(const TriangleMesh& mesh, const Pose& pose, const Vec3& eye);

}  // namespace careen
