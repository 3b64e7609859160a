#pragma once

#include <chrono>

namespace careen {

/// For measuring how long something takes.
using Clock = std::chrono::steady_clock;

/// [s] of wall time.
inline double secondsSince(Clock::time_point begun) {
  return std::chrono::duration<double>(Clock::now() - begun).count();
}

}  // namespace careen
