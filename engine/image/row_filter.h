#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace careen {

/// The difference between a row of pixels of so many bytes and its Paeth prediction, modulo 256: PNG
/// specification, 9.4, filter type 4. `above` is the previous row, or zeros; the result goes to `difference`.
/// All three have the same size and do not overlap.
void subtractPaeth(std::span<const std::uint8_t> row, std::span<const std::uint8_t> above,
                   std::size_t pixelBytes, std::span<std::uint8_t> difference);

/// The same bytes with baseline instructions only.
void subtractPaethBaseline(std::span<const std::uint8_t> row, std::span<const std::uint8_t> above,
                           std::size_t pixelBytes, std::span<std::uint8_t> difference);

}  // namespace careen
