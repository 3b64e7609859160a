#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "image/picture.h"
#include "render/gl/edge_blend.h"
#include "stage/picture_settings.h"

namespace careen {

struct Gl;

/// The render target: takes linear light, antialiases and returns sRGB.
class Canvas {
 public:
  /// InputError if GL does not support the size, MachineError if it supports fewer samples than requested.
  Canvas(const Gl& gl, int width, int height, Antialiasing antialiasing);

  /// Binds the canvas for drawing and clears it; no pixel counts as drawn.
  void begin() const;
  /// Waits until drawing is complete.
  void finish() const;
  /// Antialiases and reads back these parts of the frame; the others are as they were read before.
  /// MachineError if a pixel is blank.
  const Picture& read(std::span<const PixelRectangle> drawn);

  /// [px] of what is drawn, before it is averaged to the picture.
  int drawnWidth() const { return scale_ * width_; }
  int drawnHeight() const { return scale_ * height_; }

  /// Whether shaders must write edge distances to alpha, see edge_blend.h.
  bool wantsEdges() const;

 private:
  const Gl& gl_;
  int width_;
  int height_;
  int scale_;  // pixels drawn per picture pixel, in each direction
  Antialiasing antialiasing_;
  unsigned drawn_ = 0;
  unsigned resolved_ = 0;  // same as drawn_ unless multisampled
  std::vector<std::uint8_t> rgba_;
  std::vector<std::uint8_t> blended_;
  Picture picture_;
};

/// Converts RGBA rows, bottom row first, to a picture, averaging each `scale` x `scale` pixels in linear
/// light. Drawn pixels have an alpha above 0: MachineError, naming `renderer`, if a pixel was never drawn.
Picture pictureFromDrawing(std::span<const std::uint8_t> rgba, int width, int height, int scale,
                           const std::string& renderer);

/// MachineError, likewise, if all pixels are black.
void refuseBlack(const Picture& picture, const std::string& renderer);

}  // namespace careen
