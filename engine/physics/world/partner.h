#pragma once

#include <cstddef>

namespace careen {

/// A wall as a partner is −1 − its index.
inline int wallPartner(std::size_t wall) { return -1 - static_cast<int>(wall); }
inline std::size_t wallOf(int partner) { return static_cast<std::size_t>(-1 - partner); }

}  // namespace careen
