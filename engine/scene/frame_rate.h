#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace careen {

/// Frames per second as a ratio, so that frame k is at exactly k/fps, rounded once, never a running sum.
struct FrameRate {
  std::int64_t numerator = 30;
  std::int64_t denominator = 1;

  double frameTime(std::int64_t frame) const;  ///< [s]
  /// Frames with 0 <= time < duration: 10 s at 60 fps is 600.
  std::int64_t frameCount(double duration) const;
  std::string text() const;  ///< "30", "24000/1001"

  friend bool operator==(const FrameRate&, const FrameRate&) = default;
};

/// "30", "24000/1001", "12.5"; 23.976, 29.97, 59.94 and 119.88 mean the broadcast rates n·1000/1001.
/// InputError otherwise.
FrameRate parseFrameRate(std::string_view text);
FrameRate frameRateFrom(double framesPerSecond);

}  // namespace careen
