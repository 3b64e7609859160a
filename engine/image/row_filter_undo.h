#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace careen {

/// Undoes the filters of a picture's rows in place: PNG specification, 9.2, types 0 to 4. `rows` has the type
/// of each before its `rowBytes`; `pixel` is how many bytes a whole pixel has: 1, 2, 3, 4, 6 or 8. Stops at
/// an unknown filter type and reports it.
std::optional<int> undoFilters(std::span<std::uint8_t> rows, std::size_t rowBytes, std::size_t pixel);

}  // namespace careen
