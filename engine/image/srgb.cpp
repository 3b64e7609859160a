#include "image/srgb.h"

#include <cmath>
#include <cstddef>

namespace careen {

SrgbTables::SrgbTables() {
  for (std::size_t value = 0; value < linear_.size(); ++value) {
    const double encoded = static_cast<double>(value) / 255;
    const double light = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
    linear_[value] = static_cast<std::uint16_t>(std::lround(65535 * light));
  }
  for (std::size_t value = 0; value < encoded_.size(); ++value) {
    const double light = static_cast<double>(value) / 65535;
    const double encoded = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
    encoded_[value] = static_cast<std::uint8_t>(std::lround(255 * encoded));
  }
}

const SrgbTables& SrgbTables::get() {
  static const SrgbTables tables;
  return tables;
}

}  // namespace careen
