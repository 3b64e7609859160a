#pragma once

#include <cstdint>

namespace careen {

/// sRGB, 8 bits per channel.
struct Color {
  std::uint8_t red = 200;
  std::uint8_t green = 200;
  std::uint8_t blue = 200;
};

}  // namespace careen
