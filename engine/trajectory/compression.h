#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace careen {

/// In zlib format (RFC 1950), at the fastest level: constants and repeated times compress, doubles hardly
/// shrink at any level.
std::string compressed(std::string_view bytes);

/// Restores the `size` bytes; nullopt if `bytes` is not compressed() output of that size.
std::optional<std::string> decompressed(std::string_view bytes, std::size_t size);

}  // namespace careen
