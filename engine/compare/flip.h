#pragma once

#include <cstdint>
#include <vector>

#include "compare/ignored_regions.h"
#include "image/deep_picture.h"

namespace careen {

/// [px/°] A display of 3840 px and 0.7 m seen from 0.7 m, as in the paper.
inline constexpr double kPixelsPerDegree = 67.0206432765823;

inline constexpr std::uint64_t kMostPixelsOfFlip = std::uint64_t{1} << 26U;  ///< 8192 x 8192

struct Flip {
  double mean = 0;            ///< [1] 0: no visible difference, 1: the largest
  double largest = 0;         ///< [1]
  std::vector<float> values;  ///< [1] of every pixel, rows from the top
};

/// The difference of two pictures of one size as perceived when flipping between them: P. Andersson, J.
/// Nilsson, T. Akenine-Möller, M. Oskarsson, K. Åström, M. D. Fairchild, "ꟻLIP: A Difference Evaluator for
/// Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3 (HPG 2020), for low dynamic range, with
/// the constants of the paper. The border pixels are repeated outward. Alpha is composited over middle grey,
/// as in differenceOf(). Ignored pixels count in neither mean nor largest. InputError if the sizes differ, or
/// there are more than kMostPixelsOfFlip: it takes about 100 bytes for each.
Flip flipOf(const DeepPicture& expected, const DeepPicture& actual, double pixelsPerDegree = kPixelsPerDegree,
            const PixelMask& ignored = {});

}  // namespace careen
