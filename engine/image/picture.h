#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace careen {

/// 8-bit sRGB, rows from the top, three bytes a pixel, no padding.
struct Picture {
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]
  std::vector<std::uint8_t> rgb;
  std::vector<std::uint8_t> alpha = {};  ///< a byte a pixel, not multiplied into the colours; empty: opaque

  std::size_t rowBytes() const { return static_cast<std::size_t>(width) * 3; }
};

/// Red, green, blue and alpha of pixel after pixel.
std::vector<std::uint8_t> rgbaOf(const Picture& picture);

}  // namespace careen
