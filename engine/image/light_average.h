#pragma once

#include <cstdint>
#include <vector>

#include "image/picture.h"

namespace careen {

/// Averages pictures of one size in linear light with SrgbTables. The average of equal pictures is that
/// picture.
class LightAverage {
 public:
  /// Adds a picture `weight` times; the weights add up to 256 at most.
  void add(const Picture& picture, int weight = 1);
  /// The average of the added pictures, of which there must be at least one.
  Picture average() const;

 private:
  int width_ = 0;
  int height_ = 0;
  std::uint32_t weight_ = 0;
  std::vector<std::uint32_t> sums_;
};

}  // namespace careen
