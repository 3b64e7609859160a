#pragma once

#include <cstdint>
#include <span>

namespace careen {

/// Code lengths [bit] of a prefix code for symbols with these counts: optimal, except where lengths had to be
/// limited to `longest`. The code is complete: a single symbol is paired with an unused one, because decoders
/// reject incomplete codes. A symbol with count 0 gets length 0. At most 2^longest symbols.
void findCodeLengths(std::span<const std::uint32_t> counts, int longest, std::span<std::uint8_t> lengths);

/// The codes for those lengths, RFC 1951, 3.2.2, in the order of the stream: first bit lowest.
void findCodes(std::span<const std::uint8_t> lengths, std::span<std::uint16_t> codes);

}  // namespace careen
