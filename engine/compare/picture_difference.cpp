#include "compare/picture_difference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <utility>

#include "compare/perceptual_color.h"
#include "compare/structural_similarity.h"

namespace careen {
namespace {

using Rgb = std::array<int, 3>;

/// Linear light of every possible sample value.
template <class Sample>
const std::vector<float>& lights() {
  static const std::vector<float> kLights = [] {
    constexpr auto kFull = std::numeric_limits<Sample>::max();
    std::vector<float> table;
    for (int value = 0; value <= kFull; ++value) {
      table.push_back(lightOfSrgb(static_cast<float>(value) / kFull));
    }
    return table;
  }();
  return kLights;
}

template <class Sample>
const std::vector<Sample>& samplesOf(const DeepPicture& picture) {
  if constexpr (sizeof(Sample) == 1) {
    return picture.samples8;
  } else {
    return picture.samples16;
  }
}

/// For two pictures of one size, depth and number of channels.
template <class Sample>
class Measuring {
 public:
  Measuring(const DeepPicture& expected, const DeepPicture& actual, const PixelMask& ignored)
      : width_(expected.width),
        height_(expected.height),
        channels_(static_cast<std::size_t>(expected.channels)),
        expected_(samplesOf<Sample>(expected)),
        actual_(samplesOf<Sample>(actual)),
        ignored_(ignored) {
    result_.pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) - ignored.count;
    result_.byStep.assign(kFull + 1U, 0);
    result_.byStepOfEdges.assign(kFull + 1U, 0);
  }

  PictureDifference run() {
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; x += kBlock) {
        const Block block{.x = x, .y = y, .width = std::min(kBlock, width_ - x)};
        const auto one = expected_.subspan(placeOf(x, y), static_cast<std::size_t>(block.width) * channels_);
        if (!std::equal(one.begin(), one.end(), actual_.data() + placeOf(x, y))) {
          channels_ == 3 ? addBlock<3>(block) : addBlock<4>(block);
          differing_.push_back(block);
        }
      }
    }
    finish();
    return std::move(result_);
  }

 private:
  static constexpr int kFull = std::numeric_limits<Sample>::max();
  static constexpr int kStep = kFull / 255;  ///< 1/255 of full

  /// A run of neighbouring pixels. Most pictures differ in few pixels, and equal blocks are skipped.
  struct Block {
    int x;
    int y;
    int width;
  };
  static constexpr int kBlock = 16;

  std::size_t placeOf(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)) *
           channels_;
  }

  template <std::size_t kChannels>
  void addBlock(const Block& block) {
    const Sample* one = expected_.data() + placeOf(block.x, block.y);
    const Sample* other = actual_.data() + placeOf(block.x, block.y);
    std::uint64_t sum = 0;
    std::uint64_t squares = 0;
    for (int x = block.x; x < block.x + block.width; ++x) {
      int most = 0;
      for (std::size_t k = 0; k < kChannels; ++k) {
        const int difference = std::abs(*other++ - *one++);
        sum += static_cast<unsigned>(difference);
        squares += static_cast<std::uint64_t>(difference) * static_cast<unsigned>(difference);
        most = std::max(most, difference);
      }
      if (most != 0) {
        addPixel(x, block.y, most);
      }
    }
    sum_ += sum;
    squares_ += squares;
  }

  void addPixel(int x, int y, int most) {
    ++result_.byStep[static_cast<std::size_t>(most)];
    if (most > largest_) {
      largest_ = most;
      result_.largestX = x;
      result_.largestY = y;
    }
    if (most <= kStep) {
      return;  // the colours are too close to be visibly different
    }
    const bool edge = liesWithin(expected_, actual_, x, y) || liesWithin(actual_, expected_, x, y);
    result_.byStepOfEdges[static_cast<std::size_t>(most)] += edge ? 1 : 0;
    if (static_cast<double>(ciede2000(labAt(expected_, x, y), labAt(actual_, x, y))) > kVisible) {
      ++result_.changed;
      result_.changedByEdges += edge ? 1 : 0;
    }
  }

  Rgb at(std::span<const Sample> samples, int x, int y) const {
    const Sample* const pixel = samples.data() + placeOf(x, y);
    Rgb rgb{pixel[0], pixel[1], pixel[2]};
    if (channels_ == 4) {
      for (int& value : rgb) {
        const std::int64_t alpha = pixel[3];
        value = static_cast<int>((value * alpha + (kFull / 2) * (kFull - alpha) + kFull / 2) / kFull);
      }
    }
    return rgb;
  }

  /// Whether `samples` there is within the range of `others` there and half way to its neighbours.
  bool liesWithin(std::span<const Sample> samples, std::span<const Sample> others, int x, int y) const {
    const Rgb value = at(samples, x, y);
    const Rgb middle = at(others, x, y);
    Rgb least = middle;
    Rgb most = middle;
    for (int v = std::max(0, y - 1); v <= std::min(height_ - 1, y + 1); ++v) {
      for (int u = std::max(0, x - 1); u <= std::min(width_ - 1, x + 1); ++u) {
        const Rgb neighbor = at(others, u, v);
        for (std::size_t k = 0; k < 3; ++k) {
          least[k] = std::min(least[k], neighbor[k]);
          most[k] = std::max(most[k], neighbor[k]);
        }
      }
    }
    bool within = true;
    for (std::size_t k = 0; k < 3; ++k) {
      within &=
          2 * (value[k] + kStep) >= middle[k] + least[k] && 2 * (value[k] - kStep) <= middle[k] + most[k];
    }
    return within;
  }

  Lab labAt(std::span<const Sample> samples, int x, int y) const {
    const std::vector<float>& light = lights<Sample>();
    const Rgb rgb = at(samples, x, y);
    return labOfLight({light[static_cast<std::size_t>(rgb[0])], light[static_cast<std::size_t>(rgb[1])],
                       light[static_cast<std::size_t>(rgb[2])]});
  }

  float lumaAt(std::span<const Sample> samples, int x, int y) const {
    constexpr float kScale = 255.0F / kFull;
    const Rgb rgb = at(samples, x, y);
    return kScale * (0.299F * static_cast<float>(rgb[0]) + 0.587F * static_cast<float>(rgb[1]) +
                     0.114F * static_cast<float>(rgb[2]));
  }

  StructuralSimilarity similarity() const {
    auto block = differing_.begin();  // the first that is not above the row
    const auto read = [&](int y, std::span<float> one, std::span<float> other) {
      for (int x = 0; x < width_; ++x) {
        one[static_cast<std::size_t>(x)] = lumaAt(expected_, x, y);
      }
      std::copy(one.begin(), one.end(), other.begin());
      for (; block != differing_.end() && block->y == y; ++block) {
        for (int x = block->x; x < block->x + block->width; ++x) {
          other[static_cast<std::size_t>(x)] = lumaAt(actual_, x, y);
        }
      }
    };
    return similarityOf(width_, height_, read, ignored_);
  }

  void finish() {
    for (std::size_t step = 1; step < result_.byStep.size(); ++step) {
      result_.differing += result_.byStep[step];
    }
    result_.byStep[0] = result_.pixels - result_.differing;
    if (result_.differing == 0) {
      return;
    }
    const double samples = static_cast<double>(result_.pixels) * static_cast<double>(channels_);
    result_.largest = static_cast<double>(largest_) / kFull;
    result_.mean = static_cast<double>(sum_) / kFull / samples;
    result_.meanSquare = static_cast<double>(squares_) / kFull / kFull / samples;
    const std::size_t place = placeOf(result_.largestX, result_.largestY);
    while (std::abs(expected_[place + static_cast<std::size_t>(result_.largestChannel)] -
                    actual_[place + static_cast<std::size_t>(result_.largestChannel)]) != largest_) {
      ++result_.largestChannel;
    }
    const StructuralSimilarity found = similarity();
    result_.ssim = found.mean;
    result_.worstSsim = found.worst;
    result_.worstSsimX = found.worstX;
    result_.worstSsimY = found.worstY;
  }

  int width_;
  int height_;
  std::size_t channels_;
  std::span<const Sample> expected_;
  std::span<const Sample> actual_;
  const PixelMask& ignored_;
  PictureDifference result_;
  std::vector<Block> differing_;
  int largest_ = 0;
  std::uint64_t sum_ = 0;
  std::uint64_t squares_ = 0;
};

}  // namespace

double PictureDifference::psnr() const {
  return meanSquare > 0 ? -10 * std::log10(meanSquare) : std::numeric_limits<double>::infinity();
}

std::size_t PictureDifference::pixelsOver(double threshold, bool edgesToo) const {
  std::size_t count = 0;
  const auto full = static_cast<double>(byStep.size() - 1);
  for (std::size_t step = 1; step < byStep.size(); ++step) {
    if (static_cast<double>(step) / full > threshold) {
      count += byStep[step] - (edgesToo ? 0 : byStepOfEdges[step]);
    }
  }
  return count;
}

PictureDifference differenceOf(DeepPicture expected, DeepPicture actual, const PixelMask& ignored) {
  makeComparable(expected, actual, ignored);
  return expected.deep ? Measuring<std::uint16_t>(expected, actual, ignored).run()
                       : Measuring<std::uint8_t>(expected, actual, ignored).run();
}

}  // namespace careen
