#include <GL/glcorearb.h>

#include "render/draw/cell_mask.h"

#include <vector>

#include "render/gl/gl.h"
#include "render/gl/shader.h"

namespace careen {

CellMask::CellMask(const Gl& gl, const std::filesystem::path& shaders)
    : gl_(gl),
      array_(makeVertexArray(gl)),
      vertices_(gl, {{0, 2}}, VertexBuffer::Step::kVertex),
      program_(linkProgram(gl, shaders, {"cell_mask.vert", "black.frag"})) {}

void CellMask::draw(const PictureCells::Set& masked, int width, int height) {
  if (masked.none()) {
    return;
  }
  std::vector<float> corners;
  forRectangles([&](int column, int row) { return masked[PictureCells::indexOf(column, row)] ? 1 : 0; },
                [&](int isMasked, int column, int endColumn, int row, int endRow) {
                  if (isMasked == 0) {
                    return;
                  }
                  const PixelRectangle at =
                      PictureCells::pixelsOf(column, endColumn, row, endRow, width, height);
                  const auto x = [&](int pixels) {
                    return 2.0F * static_cast<float>(pixels) / static_cast<float>(width) - 1;
                  };
                  const auto y = [&](int pixels) {
                    return 2.0F * static_cast<float>(pixels) / static_cast<float>(height) - 1;
                  };
                  corners.insert(corners.end(),
                                 {x(at.left), y(at.bottom), x(at.right), y(at.bottom), x(at.right), y(at.top),
                                  x(at.left), y(at.bottom), x(at.right), y(at.top), x(at.left), y(at.top)});
                });
  gl_.BindVertexArray(array_);
  vertices_.fill(corners);
  gl_.UseProgram(program_);
  gl_.DrawArrays(GL_TRIANGLES, 0, vertices_.count());
}

}  // namespace careen
