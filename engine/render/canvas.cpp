#include <GL/glcorearb.h>

#include "render/canvas.h"

#include <algorithm>

#include "core/error.h"
#include "render/gl.h"

namespace careen {
namespace {

constexpr int kSamples = 4;

void checkSize(const Gl& gl, int width, int height) {
  const int most = std::min(gl.integer(GL_MAX_RENDERBUFFER_SIZE), gl.integer(GL_MAX_VIEWPORT_DIMS));
  if (width < 1 || height < 1 || width > most || height > most) {
    throw InputError("size: found " + std::to_string(width) + " x " + std::to_string(height) +
                     ", expected 1 to " + std::to_string(most) + " pixels each way");
  }
}

void attach(const Gl& gl, GLenum place, GLenum format, int samples, int width, int height) {
  GLuint buffer = 0;
  gl.GenRenderbuffers(1, &buffer);
  gl.BindRenderbuffer(GL_RENDERBUFFER, buffer);
  gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width, height);
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, buffer);
}

GLuint makeFramebuffer(const Gl& gl, int samples, int width, int height) {
  GLuint framebuffer = 0;
  gl.GenFramebuffers(1, &framebuffer);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  attach(gl, GL_COLOR_ATTACHMENT0, GL_SRGB8_ALPHA8, samples, width, height);
  if (samples > 0) {
    attach(gl, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32F, samples, width, height);
  }
  const std::string size = std::to_string(width) + " x " + std::to_string(height);
  checkGl(gl, ("a canvas of " + size).c_str());
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw MachineError("GL makes no canvas of " + size + " with " + std::to_string(samples) + " samples (" +
                       gl.description + ")");
  }
  return framebuffer;
}

}  // namespace

Canvas::Canvas(const Gl& gl, int width, int height) : gl_(gl), width_(width), height_(height) {
  checkSize(gl, width, height);
  sampled_ = makeFramebuffer(gl, std::min(kSamples, gl.integer(GL_MAX_SAMPLES)), width, height);
  resolved_ = makeFramebuffer(gl, 0, width, height);
  rgba_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
}

void Canvas::begin() const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, sampled_);
  gl_.Viewport(0, 0, width_, height_);
  gl_.Enable(GL_FRAMEBUFFER_SRGB);
  gl_.ClearColor(0, 0, 0, 0);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void Canvas::finish() const {
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, sampled_);
  gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_);
  gl_.BlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  gl_.Finish();
}

Picture Canvas::read() {
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, resolved_);
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba_.data());
  checkGl(gl_, "drawing a frame");
  return pictureFromDrawing(rgba_, width_, height_, gl_.description);
}

Picture pictureFromDrawing(std::span<const std::uint8_t> rgba, int width, int height,
                           const std::string& renderer) {
  Picture picture{.width = width, .height = height, .rgb = {}};
  const auto columns = static_cast<std::size_t>(width);
  const auto rows = static_cast<std::size_t>(height);
  picture.rgb.resize(picture.rowBytes() * rows);
  unsigned brightest = 0;
  unsigned drawn = 255;
  for (std::size_t row = 0; row < rows; ++row) {
    const std::uint8_t* from = &rgba[(rows - 1 - row) * columns * 4];
    std::uint8_t* to = &picture.rgb[row * picture.rowBytes()];
    for (std::size_t column = 0; column < columns; ++column, from += 4, to += 3) {
      to[0] = from[0];
      to[1] = from[1];
      to[2] = from[2];
      brightest |= static_cast<unsigned>(from[0]) | from[1] | from[2];
      drawn &= from[3];
    }
  }
  if (drawn != 255 || brightest == 0) {
    throw MachineError(
        std::string("the frame came out ") + (drawn != 255 ? "with pixels left blank" : "black") + ": " +
        renderer +
        " does not draw what it should; another may: --list-rendering-backends, apt install libosmesa6");
  }
  return picture;
}

}  // namespace careen
