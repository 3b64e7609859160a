#pragma once

#include <filesystem>
#include <span>

#include "render/draw/decals.h"
#include "render/draw/picture_cells.h"
#include "render/draw/visible_faces.h"
#include "render/gl/vertex_array.h"

namespace careen {

struct Gl;

/// A light of finite size.
struct ShadowLight {
  Vec3 towards = Vec3::UnitZ();  ///< unit
  double spread = 0;             ///< [1] how wide penumbras are on each side of an edge, of the distance
};

/// Shadows of boxes on floor and walls, each of which keeps off a part of what the others leave.
class ShadowBatch {
 public:
  ShadowBatch(const Gl& gl, const std::filesystem::path& shaders);
  /// `pixelAngle` [rad]; marks the cells that shadows may reach, and adds these to inputs, if there are any.
  void place(std::span<const DrawnBox> boxes, std::span<const Surface> surfaces, const ShadowLight& light,
             const Vec3& eye, double pixelAngle, const HiddenTiles& hidden, PictureCells& cells,
             CellInputs* inputs);
  /// Only what is in these cells of the inputs, if there are any.
  void fill(const CellInputs* inputs, const PictureCells::Set& cells);
  void draw() const;

 private:
  const Gl& gl_;
  Decals decals_;
  unsigned array_;
  VertexBuffer vertices_;
  IndexBuffer indices_;
  unsigned program_;
};

}  // namespace careen
