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
                     " does not draw what it should; another may: careen render --rendering-backend list, apt install " +
                     std::string(drawingPackages()));
}

Picture blackPicture(int width, int height) {
  Picture picture{.width = width, .height = height, .rgb = {}};
  picture.rgb.resize(picture.rowBytes() * static_cast<std::size_t>(height));
  return picture;
}

// These pixels of a picture; see pictureFromDrawing.
void convert(std::span<const std::uint8_t> rgba, int scale, const PixelRectangle& pixels, Picture& picture,
             const std::string& renderer) {
  const auto columns = static_cast<std::size_t>(picture.width);
  const auto times = static_cast<std::size_t>(scale);
  const auto left = static_cast<std::size_t>(pixels.left);
  const auto right = static_cast<std::size_t>(pixels.right);
  bool blank = false;
  for (auto row = static_cast<std::size_t>(pixels.bottom); row < static_cast<std::size_t>(pixels.top);
       ++row) {
    const std::uint8_t* from = &rgba[times * (row * times * columns + left) * 4];
    std::uint8_t* to =
        &picture.rgb[(static_cast<std::size_t>(picture.height) - 1 - row) * picture.rowBytes() + 3 * left];
    if (times > 1) {
      for (std::size_t column = left; column < right; ++column, from += 4 * times, to += 3) {
        blank = !average(from, times, times * columns, to) || blank;
      }
      continue;
    }
    // Simple loops, each of which takes several pixels at once.
    std::uint8_t least = 255;
    for (std::size_t i = 0; i < right - left; ++i) {
      least = std::min(least, from[4 * i + 3]);
    }
    blank = blank || least == 0;
    for (std::size_t i = 0; i < right - left; ++i) {
      to[3 * i] = from[4 * i];
      to[3 * i + 1] = from[4 * i + 1];
      to[3 * i + 2] = from[4 * i + 2];
    }
  }
  if (blank) {
    failToDraw("with pixels left blank", renderer);
  }
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
  blended_.resize(wantsEdges() ? rgba_.size() : 0);
  picture_ = blackPicture(width, height);
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

const Picture& Canvas::read(std::span<const PixelRectangle> drawn) {
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, resolved_);
  const int width = scale_ * width_;
  const int height = scale_ * height_;
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl_.PixelStorei(GL_PACK_ROW_LENGTH, width);
  for (const PixelRectangle& part : drawn) {
    const auto before = static_cast<std::size_t>(part.bottom) * static_cast<std::size_t>(width) +
                        static_cast<std::size_t>(part.left);
    gl_.ReadPixels(part.left, part.bottom, part.right - part.left, part.top - part.bottom, GL_RGBA,
                   GL_UNSIGNED_BYTE, &rgba_[4 * before]);
  }
  gl_.PixelStorei(GL_PACK_ROW_LENGTH, 0);
  checkGl(gl_, "drawing a frame");
  for (const PixelRectangle& part : drawn) {
    // Pixels of edges blend into those beside them.
    const PixelRectangle near = !wantsEdges() ? part
                                              : PixelRectangle{.left = std::max(part.left - 1, 0),
                                                               .bottom = std::max(part.bottom - 1, 0),
                                                               .right = std::min(part.right + 1, width),
                                                               .top = std::min(part.top + 1, height)};
    if (wantsEdges()) {
      blendEdges(rgba_, width, height, near, blended_);
    }
    const auto outward = [&](int end) { return (end + scale_ - 1) / scale_; };
    convert(wantsEdges() ? blended_ : rgba_, scale_,
            {.left = near.left / scale_,
             .bottom = near.bottom / scale_,
             .right = outward(near.right),
             .top = outward(near.top)},
            picture_, gl_.description);
  }
  return picture_;
}

Picture pictureFromDrawing(std::span<const std::uint8_t> rgba, int width, int height, int scale,
                           const std::string& renderer) {
  Picture picture = blackPicture(width, height);
  convert(rgba, scale, {.left = 0, .bottom = 0, .right = width, .top = height}, picture, renderer);
  return picture;
}

void refuseBlack(const Picture& picture, const std::string& renderer) {
  if (std::all_of(picture.rgb.begin(), picture.rgb.end(), [](std::uint8_t value) { return value == 0; })) {
    failToDraw("black", renderer);
  }
}

}  // namespace careen
