#include "compare/difference_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace careen {
namespace {

using Rgb = std::array<int, 3>;  // of 65535

/// Two pictures in a common format: 16 bits, with alpha if either has it.
class PicturePair {
 public:
  PicturePair(const DeepPicture& expected, const DeepPicture& actual) {
    requireOneSize(expected, actual);
    const bool alpha = expected.channels == 4 || actual.channels == 4;
    expected_ = deepened(alpha ? withAlpha(expected) : expected);
    actual_ = deepened(alpha ? withAlpha(actual) : actual);
  }

  std::size_t pixels() const {
    return static_cast<std::size_t>(expected_.width) * static_cast<std::size_t>(expected_.height);
  }

  Rgb differenceAt(std::size_t pixel) const {
    const auto channels = static_cast<std::size_t>(expected_.channels);
    const auto off = [&](std::size_t channel) {
      const std::size_t at = pixel * channels + channel;
      return std::abs(int{actual_.samples16[at]} - int{expected_.samples16[at]});
    };
    const int alpha = channels == 4 ? off(3) : 0;
    return {off(0) + alpha, off(1) + alpha, off(2) + alpha};
  }

 private:
  DeepPicture expected_;
  DeepPicture actual_;
};

constexpr int kFull = 65535;

}  // namespace

int amplificationOf(const DeepPicture& expected, const DeepPicture& actual) {
  const PicturePair pair(expected, actual);
  std::vector<int> differences;
  for (std::size_t pixel = 0; pixel < pair.pixels(); ++pixel) {
    const Rgb difference = pair.differenceAt(pixel);
    const int largest = *std::max_element(difference.begin(), difference.end());
    if (largest > 0) {
      differences.push_back(largest);
    }
  }
  if (differences.empty()) {
    return 1;
  }
  const std::size_t cutOff = differences.size() / 100;
  const auto limit = differences.end() - 1 - static_cast<std::ptrdiff_t>(cutOff);
  std::nth_element(differences.begin(), limit, differences.end());
  int factor = 1;
  while (*limit * factor * 2 <= kFull) {
    factor *= 2;
  }
  return factor;
}

Picture differenceImage(const DeepPicture& expected, const DeepPicture& actual, int factor) {
  const PicturePair pair(expected, actual);
  Picture image{.width = expected.width, .height = expected.height, .rgb = {}};
  image.rgb.reserve(pair.pixels() * 3);
  for (std::size_t pixel = 0; pixel < pair.pixels(); ++pixel) {
    for (const int difference : pair.differenceAt(pixel)) {
      const std::int64_t amplified = std::min<std::int64_t>(std::int64_t{difference} * factor, kFull);
      image.rgb.push_back(static_cast<std::uint8_t>((amplified * 255 + kFull / 2) / kFull));
    }
  }
  return image;
}

}  // namespace careen
