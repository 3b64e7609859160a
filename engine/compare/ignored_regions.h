#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/error.h"
#include "image/deep_picture.h"

namespace careen {

/// Pixels of a picture that count in no measure; empty: all count.
struct PixelMask {
  int width = 0;              ///< [px]
  std::vector<bool> ignored;  ///< of each pixel, rows from the top
  std::size_t count = 0;      ///< of those that are ignored

  bool empty() const { return ignored.empty(); }
  bool at(int x, int y) const {
    return !empty() && ignored[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                               static_cast<std::size_t>(x)];
  }
};

/// Regions that do not fit the pictures: no fault of a single frame.
struct UnfitRegions : InputError {
  using InputError::InputError;
};

/// Parts of pictures that are not compared, such as a clock.
class IgnoredRegions {
 public:
  /// "x,y,width,height" [px], from the upper left, or the path of a PNG in which white is ignored: what is
  /// brighter than half in red, green and blue, and more than half opaque. InputError if it is neither.
  void add(const std::string& text);

  bool empty() const { return names_.empty(); }
  /// As they were added.
  const std::vector<std::string>& names() const { return names_; }
  /// UnfitRegions if one is not within a picture of this size, or nothing of it would count.
  PixelMask of(int width, int height) const;

 private:
  struct Rectangle {
    int x, y, width, height;  // [px]
  };
  struct Mask {
    std::string name;
    int width, height;  // [px]
    std::vector<bool> white;
  };

  std::vector<std::string> names_;
  std::vector<Rectangle> rectangles_;
  std::vector<Mask> masks_;
};

/// Makes two pictures of one size comparable: both get the depth and the channels of the richer one, and
/// `actual` the samples of `expected` wherever they do not count: in ignored pixels, and where both are fully
/// transparent, so that nobody sees their colours.
void makeComparable(DeepPicture& expected, DeepPicture& actual, const PixelMask& ignored);

}  // namespace careen
