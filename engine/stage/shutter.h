#pragma once

#include <string>
#include <string_view>

namespace careen {

inline constexpr double kWidestShutter = 360;    ///< [deg]
inline constexpr int kMostShutterSamples = 256;  ///< what LightAverage has room for

/// How long each frame looks.
struct Shutter {
  double degrees = 0;  ///< [deg] 360 is the time from one frame to the next, 0 a moment
  int samples = 8;     ///< moments averaged

  /// "180:8", or "none" for a moment.
  std::string text() const;
};

/// "180" or "180:8", degrees and samples. InputError otherwise.
Shutter parseShutter(std::string_view text);

}  // namespace careen
