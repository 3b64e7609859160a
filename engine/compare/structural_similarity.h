#pragma once

#include <span>
#include <vector>

namespace careen {

/// One number per pixel, rows from the top.
struct SamplePlane {
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]
  std::vector<float> values;

  std::span<const float> row(int y) const {
    return std::span(values).subspan(static_cast<std::size_t>(y) * static_cast<std::size_t>(width),
                                     static_cast<std::size_t>(width));
  }
  std::span<float> row(int y) {
    return std::span(values).subspan(static_cast<std::size_t>(y) * static_cast<std::size_t>(width),
                                     static_cast<std::size_t>(width));
  }
};

struct StructuralSimilarity {
  double mean = 1;   ///< [1] over all windows
  double worst = 1;  ///< [1] minimum over all windows
  int worstX = 0;    ///< [px] centre of that window
  int worstY = 0;    ///< [px]
};

/// The SSIM of two planes of one size with values 0 … 255: Z. Wang, A. C. Bovik, H. R. Sheikh, E. P.
/// Simoncelli, "Image quality assessment: from error visibility to structural similarity", IEEE Trans. Image
/// Processing 13 (2004), equation 13 with K₁ = 0.01, K₂ = 0.03, L = 255, and a Gaussian window of 11×11 and σ
/// = 1.5 px, weights summing to 1, variances with those weights. As in the authors' program, only windows
/// entirely within the picture count, all with equal weight, and the picture is not downsampled. For a
/// picture less than 11 px wide or high, the window is the largest odd number of pixels that fits. Equal
/// windows give exactly 1.
StructuralSimilarity similarityOf(const SamplePlane& one, const SamplePlane& other);

}  // namespace careen
