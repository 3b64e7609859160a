#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "image/picture.h"
#include "stage/picture_settings.h"

namespace careen {

struct Gl;

/// What is drawn on: linear light goes in, edges are smoothed, and out comes sRGB.
class Canvas {
 public:
  /// InputError if the size is beyond what GL can do, MachineError if it has fewer samples than asked for.
  Canvas(const Gl& gl, int width, int height, Antialiasing antialiasing);

  /// Drawing goes here from now on; all is cleared, and no pixel counts as drawn.
  void begin() const;
  /// Waits until all is done.
  void finish() const;
  /// Smooths the edges. MachineError if the frame came out blank.
  Picture read();

  /// What is drawn has to say in alpha where edges are, see edge_blend.h.
  bool wantsEdges() const;

 private:
  const Gl& gl_;
  int width_;
  int height_;
  int scale_;  // pixels drawn for one of the picture, each way
  Antialiasing antialiasing_;
  unsigned drawn_ = 0;
  unsigned resolved_ = 0;  // the same but for multisampling
  std::vector<std::uint8_t> rgba_;
  std::vector<std::uint8_t> scratch_;
};

/// Rows from the bottom, four bytes a pixel, as a picture; of each `scale` x `scale` of them the average
/// light. Whatever is drawn has an alpha above 0: MachineError, naming `renderer`, if a pixel was never
/// drawn, or if all are black.
Picture pictureFromDrawing(std::span<const std::uint8_t> rgba, int width, int height, int scale,
                           const std::string& renderer);

}  // namespace careen
