#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace careen {

/// Undoes a row's filter in place: PNG specification, 9.2, types 0 to 4. `above` is the row before, undone,
/// or zeros; `pixel` is how many bytes a whole pixel has, at least 1. False if there is no such type.
bool undoFilter(int type, std::span<std::uint8_t> row, std::span<const std::uint8_t> above,
                std::size_t pixel);

}  // namespace careen
