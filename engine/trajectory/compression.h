#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace careen {

/// In the zlib format (RFC 1950), at the level that costs least: a record's constants and repeated times go,
/// what is left of its doubles hardly shrinks at any level.
std::string compressed(std::string_view bytes);

/// The `size` bytes again; nothing if these are not what compressed() made of so many.
std::optional<std::string> decompressed(std::string_view bytes, std::size_t size);

}  // namespace careen
