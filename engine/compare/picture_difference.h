#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "image/deep_picture.h"

namespace careen {

/// What one pair of pictures of one size differs by. Channels are shares of full [0 … 1] in sRGB as stored,
/// alpha one of them where either picture has it; 8 bits beside 16 count as the same share of full.
struct PictureDifference {
  std::size_t pixels = 0;
  std::size_t differing = 0;  ///< pixels that differ in any bit

  double largest = 0;      ///< of all channels
  int largestX = 0;        ///< [px] the first pixel that has it
  int largestY = 0;        ///< [px]
  int largestChannel = 0;  ///< 0 red, 1 green, 2 blue, 3 alpha
  double mean = 0;         ///< of all channels, of the absolute value
  double meanSquare = 0;   ///< of all channels

  /// Of luma 0.299 R' + 0.587 G' + 0.114 B'; see structural_similarity.h.
  double ssim = 1;
  double worstSsim = 1;  ///< of one window
  int worstSsimX = 0;    ///< [px]
  int worstSsimY = 0;    ///< [px]

  /// Pixels whose colours are more than kVisible apart in CIEDE2000, and those of them that edges explain.
  std::size_t changed = 0;
  std::size_t changedByEdges = 0;

  /// How many pixels have which largest difference of a channel, in steps of 1/255, or 1/65535 where either
  /// picture is deep; and of those with more than 1/255 the ones that edges explain.
  std::vector<std::size_t> byStep;
  std::vector<std::size_t> byStepOfEdges;

  /// [dB] 10 log₁₀(1 / mean square); infinite if nothing differs.
  double psnr() const;
  /// How many pixels have a channel more than `threshold` apart, as in idiff; without those that edges
  /// explain if so wanted.
  std::size_t pixelsOver(double threshold, bool edgesToo = true) const;
};

/// [CIEDE2000] A difference that is noticed without looking for it: M. Mahy, L. Van Eycken, A. Oosterlinck,
/// Color Research and Application 19 (1994). Where no channel is more than 1/255 apart it is not asked for:
/// two such colours are at most 2.35 apart, nearly all of them less than 2.3.
inline constexpr double kVisible = 2.3;

/// Luma, perceived colours and edges are those over middle grey where there is alpha. A pixel is explained by
/// edges if in every channel its value in one picture lies within what the other has there and half way to
/// the eight neighbours, give or take 1/255. So an edge that is drawn up to a third of a pixel elsewhere is,
/// from there to half a pixel it depends on how it is blended; one moved by a whole pixel is not, nor is a
/// line that came or went. InputError, naming both sizes, if they are not of one size.
PictureDifference differenceOf(const DeepPicture& expected, const DeepPicture& actual);

}  // namespace careen
