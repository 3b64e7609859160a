#pragma once

#include <span>
#include <vector>

#include "render/draw/drawn_box.h"
#include "view/camera.h"

namespace careen {

/// A picture in which faces hide each other.
struct PixelSamples {
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]
  /// [px] Samples are within so much of a pixel's centre in each direction, rounding of corners included: a
  /// face hides another one only where it does so anywhere in there.
  double within = 0;
};

/// Where boxes hide what is behind them, in tiles of the picture.
class HiddenTiles {
 public:
  HiddenTiles() = default;  ///< nothing is hidden
  /// `nearest`: of each pixel, row by row from below, the inverse depth [1/m] of what is drawn there at
  /// least.
  HiddenTiles(View view, const PixelSamples& samples, const std::vector<float>& nearest);

  /// Whether boxes hide all of a convex outline [m] world, which lies in a plane, and some pixels around it.
  bool hide(const std::vector<Vec3>& outline) const;

 private:
  View view_;
  int columns_ = 0;
  int rows_ = 0;
  int width_ = 0;  // [px]
  int height_ = 0;
  std::vector<float> farthest_;  // of each tile's pixels
};

struct Visible {
  std::vector<DrawnFace> faces;
  HiddenTiles hidden;
};

/// Those faces that have a sample in the picture, in the same order, by a depth buffer of their own; faces
/// should come front to back. Some that have no sample may be among them, where faces nearly touch or end
/// beside a pixel's centre.
Visible visibleFaces(std::span<const DrawnFace> faces, const View& view, const PixelSamples& samples);

}  // namespace careen
