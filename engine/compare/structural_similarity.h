#pragma once

#include <functional>
#include <span>

#include "compare/ignored_regions.h"

namespace careen {

/// Gives row `y`, from the top, of two pictures of one size, with one number per pixel.
using RowReader = std::function<void(int y, std::span<float> one, std::span<float> other)>;

struct StructuralSimilarity {
  double mean = 1;   ///< [1] over all windows
  double worst = 1;  ///< [1] minimum over all windows
  int worstX = 0;    ///< [px] centre of that window
  int worstY = 0;    ///< [px]
};

/// The SSIM of two pictures of this size [px] with values 0 … 255: Z. Wang, A. C. Bovik, H. R. Sheikh, E. P.
/// Simoncelli, "Image quality assessment: from error visibility to structural similarity", IEEE Trans. Image
/// Processing 13 (2004), equation 13 with K₁ = 0.01, K₂ = 0.03, L = 255, and a Gaussian window of 11×11 and σ
/// = 1.5 px, weights summing to 1, variances with those weights. As in the authors' program, only windows
/// entirely within the picture count, all with equal weight, and the picture is not downsampled. For a
/// picture less than 11 px wide or high, the window is the largest odd number of pixels that fits. Equal
/// windows give exactly 1. Windows around an ignored pixel do not count. Rows are read once, in order; a
/// window's height of them is held.
StructuralSimilarity similarityOf(int width, int height, const RowReader& read,
                                  const PixelMask& ignored = {});

}  // namespace careen
