#pragma once

#include <array>
#include <cstdint>

#include "compare/ignored_regions.h"
#include "image/deep_picture.h"
#include "image/picture.h"

namespace careen {

/// The factor that makes a difference of two comparable pictures, see makeComparable(), visible: the largest
/// power of two, at least 1, at which at most a hundredth of the differing pixels are clipped.
int amplificationOf(const DeepPicture& expected, const DeepPicture& actual);

/// The absolute difference of red, green and blue, times `factor`, clipped: black where both are the same. A
/// difference of alpha is added to all three. The two must be comparable, as above.
Picture differenceImage(const DeepPicture& expected, const DeepPicture& actual, int factor);

/// Stripes and an outline in kMarkColor where pixels are ignored, black elsewhere; width and height of the
/// stripes follow the picture's.
inline constexpr std::array<std::uint8_t, 3> kMarkColor{255, 225, 77};
Picture ignoredImage(const PixelMask& ignored);

}  // namespace careen
