#pragma once

#include <cstdint>
#include <vector>

#include "image/picture.h"

namespace careen {

/// Averages pictures of one size as light, not as codes, by SrgbTables. Equal pictures give that picture.
class LightAverage {
 public:
  /// `weight` times; 256 in all, at most.
  void add(const Picture& picture, int weight = 1);
  /// Of what was added, which must be something.
  Picture average() const;

 private:
  int width_ = 0;
  int height_ = 0;
  std::uint32_t weight_ = 0;
  std::vector<std::uint32_t> sums_;
};

}  // namespace careen
