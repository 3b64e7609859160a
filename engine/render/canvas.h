#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "image/picture.h"

namespace careen {

struct Gl;

/// What is drawn on: linear light goes in, is averaged over four samples a pixel, and comes out as sRGB.
class Canvas {
 public:
  /// InputError if the size is beyond what GL can do.
  Canvas(const Gl& gl, int width, int height);

  /// Drawing goes here from now on; all is cleared, and no pixel counts as drawn.
  void begin() const;
  /// Averages the samples and waits until all is done.
  void finish() const;
  /// MachineError if the frame came out blank.
  Picture read();

  int width() const { return width_; }
  int height() const { return height_; }

 private:
  const Gl& gl_;
  int width_;
  int height_;
  unsigned sampled_ = 0;
  unsigned resolved_ = 0;
  std::vector<std::uint8_t> rgba_;
};

/// Rows from the bottom, four bytes a pixel, as a picture. Whatever is drawn has alpha 255: MachineError,
/// naming `renderer`, if a pixel was never drawn, or if all are black.
Picture pictureFromDrawing(std::span<const std::uint8_t> rgba, int width, int height,
                           const std::string& renderer);

}  // namespace careen
