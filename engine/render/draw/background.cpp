#include <GL/glcorearb.h>

#include "render/draw/background.h"

#include "render/gl/gl.h"
#include "render/gl/shader.h"
#include "render/gl/vertex_array.h"

namespace careen {

Background::Background(const Gl& gl, const std::filesystem::path& shaders)
    : gl_(gl),
      shaders_(shaders),
      array_(makeVertexArray(gl)),
      program_(linkProgram(gl, shaders,
                           {"background.vert", "background.frag", "write_lit.frag", "finish.frag"})) {}

void Background::draw(std::span<const PixelRectangle> parts) const { drawBy(program_, parts); }

void Background::drawBlack(std::span<const PixelRectangle> parts) {
  if (blackProgram_ == 0) {
    blackProgram_ = linkProgram(gl_, shaders_, {"background.vert", "background.frag", "write_black.frag"});
  }
  drawBy(blackProgram_, parts);
}

void Background::drawBy(unsigned program, std::span<const PixelRectangle> parts) const {
  gl_.UseProgram(program);
  gl_.BindVertexArray(array_);
  gl_.Enable(GL_SCISSOR_TEST);
  for (const PixelRectangle& at : parts) {
    gl_.Scissor(at.left, at.bottom, at.right - at.left, at.top - at.bottom);
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  }
  gl_.Disable(GL_SCISSOR_TEST);
}

}  // namespace careen
