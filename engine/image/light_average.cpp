#include "image/light_average.h"

#include <cstddef>

#include "image/srgb.h"

namespace careen {

void LightAverage::add(const Picture& picture, int weight) {
  const SrgbTables& srgb = SrgbTables::get();
  width_ = picture.width;
  height_ = picture.height;
  sums_.resize(picture.rgb.size());
  const auto times = static_cast<std::uint32_t>(weight);
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    sums_[i] += times * srgb.linear(picture.rgb[i]);
  }
  weight_ += times;
}

Picture LightAverage::average() const {
  const SrgbTables& srgb = SrgbTables::get();
  Picture picture{.width = width_, .height = height_, .rgb = {}};
  picture.rgb.resize(sums_.size());
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    picture.rgb[i] = srgb.encoded(static_cast<std::uint16_t>((sums_[i] + weight_ / 2) / weight_));
  }
  return picture;
}

}  // namespace careen
