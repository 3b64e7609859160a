#pragma once

#include <cstddef>

namespace careen {

/// Ours are int, those of the standard library std::size_t.
inline std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace careen
