#include "compare/difference_image.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace careen {
namespace {

using Rgb = std::array<int, 3>;  // of 65535

constexpr int kFull = 65535;
constexpr int kMostDifference = 2 * kFull;  // of a colour and of alpha

/// The differences of two comparable pictures, pixel by pixel.
class Differences {
 public:
  Differences(const DeepPicture& expected, const DeepPicture& actual)
      : expected_(expected), actual_(actual), channels_(static_cast<std::size_t>(expected.channels)) {}

  std::size_t pixels() const { return expected_.samples() / channels_; }

  Rgb at(std::size_t pixel) const {
    const auto off = [&](std::size_t channel) {
      const std::size_t place = pixel * channels_ + channel;
      return expected_.deep ? std::abs(int{actual_.samples16[place]} - int{expected_.samples16[place]})
                            : 257 * std::abs(int{actual_.samples8[place]} - int{expected_.samples8[place]});
    };
    const int alpha = channels_ == 4 ? off(3) : 0;
    return {off(0) + alpha, off(1) + alpha, off(2) + alpha};
  }

 private:
  const DeepPicture& expected_;
  const DeepPicture& actual_;
  std::size_t channels_;
};

}  // namespace

int amplificationOf(const DeepPicture& expected, const DeepPicture& actual) {
  const Differences differences(expected, actual);
  std::vector<std::size_t> count(kMostDifference + 1);
  std::size_t differing = 0;
  for (std::size_t pixel = 0; pixel < differences.pixels(); ++pixel) {
    const Rgb difference = differences.at(pixel);
    const int largest = *std::max_element(difference.begin(), difference.end());
    ++count[static_cast<std::size_t>(largest)];
    differing += largest > 0 ? 1 : 0;
  }
  if (differing == 0) {
    return 1;
  }
  int limit = kMostDifference;  // a hundredth of the differing pixels differ by more
  for (std::size_t above = count.back(); above <= differing / 100;) {
    --limit;
    above += count[static_cast<std::size_t>(limit)];
  }
  int factor = 1;
  while (limit * factor * 2 <= kFull) {
    factor *= 2;
  }
  return factor;
}

Picture differenceImage(const DeepPicture& expected, const DeepPicture& actual, int factor) {
  const Differences differences(expected, actual);
  Picture image{.width = expected.width, .height = expected.height, .rgb = {}};
  image.rgb.reserve(differences.pixels() * 3);
  for (std::size_t pixel = 0; pixel < differences.pixels(); ++pixel) {
    for (const int difference : differences.at(pixel)) {
      const std::int64_t amplified = std::min<std::int64_t>(std::int64_t{difference} * factor, kFull);
      image.rgb.push_back(static_cast<std::uint8_t>((amplified * 255 + kFull / 2) / kFull));
    }
  }
  return image;
}

Picture ignoredImage(const PixelMask& ignored) {
  const int width = ignored.width;
  const int height = static_cast<int>(ignored.ignored.size() / static_cast<std::size_t>(width));
  const int period = std::max(8, std::max(width, height) / 80);
  const int outline = std::max(1, period / 8);
  Picture image{.width = width, .height = height, .rgb = {}};
  image.rgb.resize(image.rowBytes() * static_cast<std::size_t>(height));
  const auto counts = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < width && y < height && !ignored.at(x, y);
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool atEdge = counts(x - outline, y) || counts(x + outline, y) || counts(x, y - outline) ||
                          counts(x, y + outline);
      if (ignored.at(x, y) && (atEdge || (x + y) % period < period / 4)) {
        std::copy(kMarkColor.begin(), kMarkColor.end(),
                  image.rgb.begin() + static_cast<std::ptrdiff_t>(y) * width * 3 + std::ptrdiff_t{3} * x);
      }
    }
  }
  return image;
}

}  // namespace careen
