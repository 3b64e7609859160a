#pragma once

#include <cstddef>
#include <cstdint>

#include "image/picture.h"

namespace careen {

/// To a compressor this looks like a drawn frame: smooth shades, tiles, and one grey level of grain.
inline Picture shadedTiles(int width, int height, unsigned seed = 1) {
  Picture picture{.width = width, .height = height, .rgb = {}};
  picture.rgb.reserve(picture.rowBytes() * static_cast<std::size_t>(height));
  std::uint32_t random = seed;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      random = random * 1664525U + 1013904223U;
      const int tile = ((x / 37 + y / 23) % 2) * 12;
      const int grain = (random >> 24U) < 40 ? 1 : 0;
      for (int channel = 0; channel < 3; ++channel) {
        const int shade = 90 + tile + channel * 9 + x * 60 / width + y * 40 / height + grain;
        picture.rgb.push_back(static_cast<std::uint8_t>(shade));
      }
    }
  }
  return picture;
}

/// Incompressible.
inline Picture noise(int width, int height, unsigned seed) {
  Picture picture{.width = width, .height = height, .rgb = {}};
  std::uint32_t random = seed;
  for (std::size_t i = picture.rowBytes() * static_cast<std::size_t>(height); i > 0; --i) {
    random = random * 1664525U + 1013904223U;
    picture.rgb.push_back(static_cast<std::uint8_t>(random >> 24U));
  }
  return picture;
}

inline Picture flat(int width, int height, std::uint8_t level) {
  Picture picture{.width = width, .height = height, .rgb = {}};
  picture.rgb.assign(picture.rowBytes() * static_cast<std::size_t>(height), level);
  return picture;
}

}  // namespace careen
