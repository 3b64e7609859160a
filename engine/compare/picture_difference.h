#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "compare/ignored_regions.h"
#include "image/deep_picture.h"

namespace careen {

/// Differences of two pictures of one size. Channels are fractions of full scale [0 … 1] in sRGB as stored,
/// including alpha if either picture has it; 8 and 16 bits are compared as fractions of full scale.
struct PictureDifference {
  std::size_t pixels = 0;     ///< that count
  std::size_t differing = 0;  ///< pixels that differ in any bit

  double largest = 0;      ///< maximum over all channels
  int largestX = 0;        ///< [px] the first pixel with that difference
  int largestY = 0;        ///< [px]
  int largestChannel = 0;  ///< 0 red, 1 green, 2 blue, 3 alpha
  double mean = 0;         ///< mean of the absolute value over all channels
  double meanSquare = 0;   ///< over all channels

  /// SSIM of luma 0.299 R' + 0.587 G' + 0.114 B'; see structural_similarity.h.
  double ssim = 1;
  double worstSsim = 1;  ///< minimum over all windows
  int worstSsimX = 0;    ///< [px]
  int worstSsimY = 0;    ///< [px]

  /// Pixels whose colours differ by more than kVisible in CIEDE2000, and how many of them edges explain.
  std::size_t changed = 0;
  std::size_t changedByEdges = 0;

  /// Histogram of the largest channel difference of each pixel, in steps of 1/255, or 1/65535 if either
  /// picture has 16 bits; and, among those above 1/255, the histogram of the pixels that edges explain.
  std::vector<std::size_t> byStep;
  std::vector<std::size_t> byStepOfEdges;

  /// [dB] 10 log₁₀(1 / mean square); infinite if nothing differs.
  double psnr() const;
  /// Number of pixels with a channel difference above `threshold`, as in idiff; optionally without those that
  /// edges explain.
  std::size_t pixelsOver(double threshold, bool edgesToo = true) const;
};

/// [CIEDE2000] A just noticeable difference: M. Mahy, L. Van Eycken, A. Oosterlinck, Color Research and
/// Application 19 (1994). It is not evaluated where no channel differs by more than 1/255: two such colours
/// differ by at most 2.35, nearly all of them by less than 2.3.
inline constexpr double kVisible = 2.3;

/// Where there is alpha, luma, perceived colours and edges are computed over middle grey. Edges explain a
/// pixel if in every channel its value in one picture lies within the range of the other picture's value
/// there and half way to its eight neighbours, give or take 1/255. So edges explain a shift of up to a third
/// of a pixel; from there to half a pixel it depends on their blending. They do not explain a shift by a
/// whole pixel, nor a line that appears or disappears. Ignored pixels count in nothing. InputError, naming
/// both sizes, if they differ. The two are passed by value because they may have to be changed, see
/// makeComparable().
PictureDifference differenceOf(DeepPicture expected, DeepPicture actual, const PixelMask& ignored = {});

}  // namespace careen
