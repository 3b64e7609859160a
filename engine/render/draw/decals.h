#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/draw/cell_inputs.h"
#include "render/draw/drawn_box.h"
#include "view/surfaces.h"

namespace careen {

/// The part of a surface that the shadow of a box may reach with its penumbra, as a convex outline [m] world;
/// empty if there is none. `towards` is the unit vector to the light, `spread` [1] how wide penumbras are on
/// each side of an edge, of the distance; `pixel` [m] is the width of a pixel on the surface there.
std::vector<Vec3> shadowOutline(const DrawnBox& box, const Surface& surface, const Vec3& towards,
                                double spread, double pixel);

/// The part of a surface where a box covers more than about `least` of what it sees, no farther from the
/// box's centre than `within` [m]; as shadowOutline.
std::vector<Vec3> occlusionOutline(const DrawnBox& box, const Surface& surface, double least, double within);

/// The part of a surface where so much of what it sees is covered by what is as large as the box, but at its
/// centre; as shadowOutline.
std::vector<Vec3> farOcclusionOutline(const DrawnBox& box, const Surface& surface, double least);

/// Vertices of outlines, each with what belongs to all its vertices, and triangles between them.
struct Decals {
  std::vector<float> vertices;
  std::vector<std::uint32_t> triangles;
  std::uint32_t count = 0;  ///< of vertices
  PieceVertices pieces;     ///< if there are inputs of cells

  /// Appends the triangles of a convex outline whose vertices follow.
  void addFan(std::size_t corners);
};

}  // namespace careen
