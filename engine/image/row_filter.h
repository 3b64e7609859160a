#pragma once

#include <cstdint>
#include <span>

namespace careen {

/// What a row of 8-bit RGB is beyond its Paeth prediction, modulo 256: PNG specification, 9.4, filter type 4.
/// `above` is the row before, or zeros; `difference` gets the bytes. All three are of one size, no two
/// overlap.
void subtractPaeth(std::span<const std::uint8_t> row, std::span<const std::uint8_t> above,
                   std::span<std::uint8_t> difference);

/// The same bytes with no more than every processor of the kind has.
void subtractPaethPlainly(std::span<const std::uint8_t> row, std::span<const std::uint8_t> above,
                          std::span<std::uint8_t> difference);

}  // namespace careen
