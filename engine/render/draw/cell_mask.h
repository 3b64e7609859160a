#pragma once

#include <filesystem>

#include "render/draw/picture_cells.h"
#include "render/gl/vertex_array.h"

namespace careen {

struct Gl;

/// Keeps what is drawn next, with a depth test, out of cells of the picture.
class CellMask {
 public:
  CellMask(const Gl& gl, const std::filesystem::path& shaders);
  /// Of a picture of this size [px], whatever the size of what is drawn.
  void draw(const PictureCells::Set& masked, int width, int height);

 private:
  const Gl& gl_;
  unsigned array_;
  VertexBuffer vertices_;
  unsigned program_;
};

}  // namespace careen
