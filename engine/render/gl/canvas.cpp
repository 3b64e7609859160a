#include <GL/glcorearb.h>

#include "render/gl/canvas.h"

#include <algorithm>
#include <array>
#include <string>

#include "core/error.h"
#include "core/system/release.h"
#include "image/srgb.h"
#include "render/gl/edge_blend.h"
#include "render/gl/gl.h"

namespace careen {
namespace {

constexpr int kSamples = 4;

void checkSize(const Gl& gl, int width, int height, int scale) {
  const int most = std::min(gl.integer(GL_MAX_RENDERBUFFER_SIZE), gl.integer(GL_MAX_VIEWPORT_DIMS)) / scale;
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

// Fewer samples would give a different picture than requested; softpipe supports only one.
int samplesOf(const Gl& gl, Antialiasing antialiasing) {
  if (antialiasing != Antialiasing::kMultisampled) {
    return 0;
  }
  if (const int most = gl.integer(GL_MAX_SAMPLES); most < kSamples) {
    throw MachineError("antialiasing: found at most " + std::to_string(most) + " of " +
                       std::to_string(kSamples) + " samples a pixel (" + gl.description +
                       "); \"edges\" needs none");
  }
  return kSamples;
}

GLuint makeFramebuffer(const Gl& gl, int samples, bool depth, int width, int height) {
  GLuint framebuffer = 0;
  gl.GenFramebuffers(1, &framebuffer);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  attach(gl, GL_COLOR_ATTACHMENT0, GL_SRGB8_ALPHA8, samples, width, height);
  if (depth) {
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

// Averages times x times pixels in linear light; false if one of them was never drawn.
bool average(const std::uint8_t* from, std::size_t times, std::size_t rowPixels, std::uint8_t* to) {
  const SrgbTables& tables = SrgbTables::get();
  std::array<std::uint32_t, 3> light{};
  bool drawn = true;
  std::uint32_t count = 0;
  do {
    const std::uint8_t* const pixel = from + 4 * (count / times * rowPixels + count % times);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      light[channel] += tables.linear(pixel[channel]);
    }
    drawn = drawn && pixel[3] != 0;
    ++count;
  } while (count < times * times);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    to[channel] = tables.encoded(static_cast<std::uint16_t>((light[channel] + count / 2) / count));
  }
  return drawn;
}

[[noreturn]] void failToDraw(const char* how, const std::string& renderer) {
  throw MachineError(std::string("the frame came out ") + how + ": " + renderer +
                     " does not draw what it should; another may: --list-rendering-backends, apt install " +
                     std::string(drawingPackages()));
}

}  // namespace

Canvas::Canvas(const Gl& gl, int width, int height, Antialiasing antialiasing)
    : gl_(gl),
      width_(width),
      height_(height),
      scale_(antialiasing == Antialiasing::kSupersampled ? 2 : 1),
      antialiasing_(antialiasing) {
  checkSize(gl, width, height, scale_);
  const int samples = samplesOf(gl, antialiasing);
  drawn_ = makeFramebuffer(gl, samples, true, scale_ * width, scale_ * height);
  resolved_ = samples > 0 ? makeFramebuffer(gl, 0, false, width, height) : drawn_;
  rgba_.resize(static_cast<std::size_t>(scale_ * width) * static_cast<std::size_t>(scale_ * height) * 4);
  scratch_.resize(wantsEdges() ? rgba_.size() : 0);
}

bool Canvas::wantsEdges() const {
  return antialiasing_ == Antialiasing::kEdges || antialiasing_ == Antialiasing::kSupersampled;
}

void Canvas::begin() const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, drawn_);
  gl_.Viewport(0, 0, scale_ * width_, scale_ * height_);
  gl_.Enable(GL_FRAMEBUFFER_SRGB);
  gl_.ClearColor(0, 0, 0, 0);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void Canvas::finish() const {
  if (resolved_ != drawn_) {
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, drawn_);
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_);
    gl_.BlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
  gl_.Finish();
}

Picture Canvas::read() {
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, resolved_);
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl_.ReadPixels(0, 0, scale_ * width_, scale_ * height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba_.data());
  checkGl(gl_, "drawing a frame");
  if (wantsEdges()) {
    blendEdges(rgba_, scale_ * width_, scale_ * height_, scratch_);
  }
  return pictureFromDrawing(rgba_, width_, height_, scale_, gl_.description);
}

Picture pictureFromDrawing(std::span<const std::uint8_t> rgba, int width, int height, int scale,
                           const std::string& renderer) {
  Picture picture{.width = width, .height = height, .rgb = {}};
  const auto columns = static_cast<std::size_t>(width);
  const auto rows = static_cast<std::size_t>(height);
  const auto times = static_cast<std::size_t>(scale);
  picture.rgb.resize(picture.rowBytes() * rows);
  bool blank = false;
  for (std::size_t row = 0; row < rows; ++row) {
    const std::uint8_t* from = &rgba[times * (rows - 1 - row) * times * columns * 4];
    std::uint8_t* to = &picture.rgb[row * picture.rowBytes()];
    for (std::size_t column = 0; column < columns; ++column, from += 4 * times, to += 3) {
      if (times > 1) {
        blank = !average(from, times, times * columns, to) || blank;
      } else {
        std::copy_n(from, 3, to);
        blank = blank || from[3] == 0;
      }
    }
  }
  if (blank) {
    failToDraw("with pixels left blank", renderer);
  }
  return picture;
}

void refuseBlack(const Picture& picture, const std::string& renderer) {
  if (std::all_of(picture.rgb.begin(), picture.rgb.end(), [](std::uint8_t value) { return value == 0; })) {
    failToDraw("black", renderer);
  }
}

}  // namespace careen
