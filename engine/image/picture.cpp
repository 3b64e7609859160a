#include "image/picture.h"

#include <limits>

namespace careen {

std::vector<std::uint8_t> rgbaOf(const Picture& picture) {
  constexpr std::uint8_t kOpaque = std::numeric_limits<std::uint8_t>::max();
  const std::size_t pixels = picture.rgb.size() / 3;
  std::vector<std::uint8_t> rgba;
  rgba.reserve(4 * pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::uint8_t* const pixel = &picture.rgb[3 * i];
    rgba.insert(rgba.end(),
                {pixel[0], pixel[1], pixel[2], picture.alpha.empty() ? kOpaque : picture.alpha[i]});
  }
  return rgba;
}

}  // namespace careen
