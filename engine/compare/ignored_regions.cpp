#include "compare/ignored_regions.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <utility>

namespace careen {
namespace {

std::string sizeText(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height) + " pixels";
}

// Four whole numbers with commas between them.
std::optional<std::array<int, 4>> fourNumbers(const std::string& text) {
  std::array<int, 4> numbers{};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0 && (at == end || *at++ != ',')) {
      return std::nullopt;
    }
    const std::from_chars_result read = std::from_chars(at, end, numbers[i]);
    if (read.ec != std::errc()) {
      return std::nullopt;
    }
    at = read.ptr;
  }
  return at == end ? std::optional(numbers) : std::nullopt;
}

template <class Sample>
std::vector<bool> whiteOf(const std::vector<Sample>& samples, std::size_t channels) {
  constexpr int kHalf = static_cast<Sample>(-1) / 2;
  std::vector<bool> white;
  white.reserve(samples.size() / channels);
  for (auto pixel = samples.begin(); pixel != samples.end(); pixel += static_cast<std::ptrdiff_t>(channels)) {
    white.push_back(std::all_of(pixel, pixel + static_cast<std::ptrdiff_t>(channels),
                                [](Sample sample) { return sample > kHalf; }));
  }
  return white;
}

template <class Sample>
void copyWhatDoesNotCount(const std::vector<Sample>& from, std::vector<Sample>& to, std::size_t channels,
                          const PixelMask& ignored) {
  if (channels != 4 && ignored.empty()) {
    return;
  }
  for (std::size_t pixel = 0; pixel < from.size() / channels; ++pixel) {
    const std::size_t at = pixel * channels;
    const bool isClear = channels == 4 && from[at + 3] == 0 && to[at + 3] == 0;
    if (isClear || (!ignored.empty() && ignored.ignored[pixel])) {
      std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(at), channels,
                  to.begin() + static_cast<std::ptrdiff_t>(at));
    }
  }
}

}  // namespace

void IgnoredRegions::add(const std::string& text) {
  if (const std::optional<std::array<int, 4>> found = fourNumbers(text)) {
    const auto [x, y, width, height] = *found;
    if (x < 0 || y < 0 || width < 1 || height < 1) {
      throw InputError("--ignore: found '" + text + "', expected x and y from 0, width and height from 1");
    }
    rectangles_.push_back({x, y, width, height});
  } else if (text.find('.') == std::string::npos && text.find('/') == std::string::npos) {
    throw InputError("--ignore: found '" + text + "', expected x,y,width,height in pixels, or a PNG mask");
  } else {
    const DeepPicture mask = readDeepPng(text);
    const auto channels = static_cast<std::size_t>(mask.channels);
    std::vector<bool> white =
        mask.deep ? whiteOf(mask.samples16, channels) : whiteOf(mask.samples8, channels);
    if (std::find(white.begin(), white.end(), true) == white.end()) {
      throw InputError("--ignore: found no white pixel in " + text +
                       ", expected what is ignored to be white");
    }
    masks_.push_back({.name = text, .width = mask.width, .height = mask.height, .white = std::move(white)});
  }
  names_.push_back(text);
}

PixelMask IgnoredRegions::of(int width, int height) const {
  PixelMask mask;
  if (empty()) {
    return mask;
  }
  mask.width = width;
  mask.ignored.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (const Rectangle& each : rectangles_) {
    if (each.x > width - each.width || each.y > height - each.height) {
      throw UnfitRegions("--ignore: found " + std::to_string(each.x) + "," + std::to_string(each.y) + "," +
                         std::to_string(each.width) + "," + std::to_string(each.height) +
                         ", expected a rectangle within the pictures' " + sizeText(width, height));
    }
    for (int y = each.y; y < each.y + each.height; ++y) {
      const auto row = mask.ignored.begin() + std::ptrdiff_t{y} * width + each.x;
      std::fill(row, row + each.width, true);
    }
  }
  for (const Mask& each : masks_) {
    if (each.width != width || each.height != height) {
      throw UnfitRegions("--ignore: found " + each.name + " of " + sizeText(each.width, each.height) +
                         ", expected a mask of the pictures' " + sizeText(width, height));
    }
    std::transform(each.white.begin(), each.white.end(), mask.ignored.begin(), mask.ignored.begin(),
                   [](bool one, bool other) { return one || other; });
  }
  mask.count = static_cast<std::size_t>(std::count(mask.ignored.begin(), mask.ignored.end(), true));
  if (mask.count == mask.ignored.size()) {
    throw UnfitRegions("--ignore: found all of the pictures' " + sizeText(width, height) +
                       " ignored, expected some that count");
  }
  return mask;
}

void makeComparable(DeepPicture& expected, DeepPicture& actual, const PixelMask& ignored) {
  requireOneSize(expected, actual);
  for (DeepPicture* const each : {&expected, &actual}) {
    if (expected.deep != actual.deep && !each->deep) {
      *each = deepened(*each);
    }
  }
  for (DeepPicture* const each : {&expected, &actual}) {
    if (expected.channels != actual.channels && each->channels == 3) {
      *each = withAlpha(*each);
    }
  }
  const auto channels = static_cast<std::size_t>(expected.channels);
  copyWhatDoesNotCount(expected.samples8, actual.samples8, channels, ignored);
  copyWhatDoesNotCount(expected.samples16, actual.samples16, channels, ignored);
}

}  // namespace careen
