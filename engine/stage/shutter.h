#pragma once

#include <string>
#include <string_view>

namespace careen {

inline constexpr double kWidestShutter = 360;    ///< [deg]
inline constexpr int kMostShutterSamples = 256;  ///< capacity of LightAverage

/// Exposure of each frame.
struct Shutter {
  double degrees = 0;  ///< [deg] 360 is the full frame interval, 0 an instant
  int samples = 8;     ///< times averaged

  /// "180:8", or "none" for an instant.
  std::string text() const;
};

/// "180" or "180:8", degrees and samples. InputError otherwise.
Shutter parseShutter(std::string_view text);

}  // namespace careen
