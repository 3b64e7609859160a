#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "image/deep_picture.h"
#include "image/pictures.h"

namespace careen {

inline DeepPicture deepPicture(Picture picture) {
  return {.width = picture.width,
          .height = picture.height,
          .channels = 3,
          .deep = false,
          .samples8 = std::move(picture.rgb),
          .samples16 = {}};
}

inline DeepPicture flatPicture(int width, int height, int red, int green, int blue) {
  DeepPicture picture{.width = width, .height = height, .samples8 = {}, .samples16 = {}};
  for (int i = 0; i < width * height; ++i) {
    for (const int value : {red, green, blue}) {
      picture.samples8.push_back(static_cast<std::uint8_t>(value));
    }
  }
  return picture;
}

/// An upright box of one colour in front of shaded tiles; its edges are blended by pixel coverage.
struct BoxPicture {
  double left = 60.3;  ///< [px]
  double top = 40.6;   ///< [px]
  double size = 50;    ///< [px]
  int red = 200;

  DeepPicture draw(int width = 320, int height = 180) const {
    DeepPicture picture = deepPicture(shadedTiles(width, height));
    const auto covered = [](double begin, double end, int pixel) {
      return std::clamp(std::min(end, pixel + 1.0) - std::max(begin, pixel * 1.0), 0.0, 1.0);
    };
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double share = covered(left, left + size, x) * covered(top, top + size, y);
        const std::array<int, 3> color{red, 85, 61};
        for (std::size_t k = 0; k < 3; ++k) {
          std::uint8_t& value = picture.samples8[3 * static_cast<std::size_t>(y * width + x) + k];
          value = static_cast<std::uint8_t>(std::lround(share * color[k] + (1 - share) * value));
        }
      }
    }
    return picture;
  }
};

}  // namespace careen
