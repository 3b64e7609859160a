#pragma once

#include <cstdint>
#include <span>

namespace careen {

/// Lengths [bit] of the prefix code that sends symbols of these counts in few bits: the least there are, but
/// where a length had to be cut to `longest`. The code is complete: a single symbol gets company that is
/// never sent, since readers refuse others. A symbol without a count gets 0. No more than 2^longest symbols.
void findCodeLengths(std::span<const std::uint32_t> counts, int longest, std::span<std::uint8_t> lengths);

/// The codes of those lengths, RFC 1951, 3.2.2, first bit lowest, as the stream takes them.
void findCodes(std::span<const std::uint8_t> lengths, std::span<std::uint16_t> codes);

}  // namespace careen
