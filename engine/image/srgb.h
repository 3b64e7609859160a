#pragma once

#include <array>
#include <cstdint>

namespace careen {

/// Conversion of sRGB values (IEC 61966-2-1) to linear light in 16 bits, 0 … 65535, and back to the nearest
/// value. Averages of pixels are taken in linear light.
class SrgbTables {
 public:
  static const SrgbTables& get();

  std::uint16_t linear(std::uint8_t encoded) const { return linear_[encoded]; }
  std::uint8_t encoded(std::uint16_t linear) const { return encoded_[linear]; }

 private:
  SrgbTables();

  std::array<std::uint16_t, 256> linear_{};
  std::array<std::uint8_t, 65536> encoded_{};
};

}  // namespace careen
