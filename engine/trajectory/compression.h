#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace careen {

/// decompressed() makes at most this many bytes of one, which bounds the memory that a crafted file can ask
/// for; DEFLATE could make 1032. Measured on shipped scenes: 1.4 (gas) to 8.2 (zeno).
inline constexpr std::size_t kMostRatio = 64;

/// In zlib format (RFC 1950), at the fastest level: constants and repeated times compress, doubles hardly
/// shrink at any level. What would shrink by more than kMostRatio is stored as it is.
std::string compressed(std::string_view bytes);

/// Restores the `size` bytes; nullopt if `bytes` is not compressed() output of that size, or shorter than a
/// kMostRatio-th of it.
std::optional<std::string> decompressed(std::string_view bytes, std::size_t size);

}  // namespace careen
