#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace careen {

/// Frames per second as a ratio in lowest terms, so that frame k is at exactly k/fps, rounded once, never a
/// running sum. Created by parseFrameRate and frameRateFrom, which keep the denominator within 10⁶.
struct FrameRate {
  std::int64_t numerator = 30;
  std::int64_t denominator = 1;

  /// k · denominator / numerator [s]: the integer product is exact, so only the division rounds. Valid for
  /// frames up to kMostFrames.
  double frameTime(std::int64_t frame) const;
  /// Number of frames with 0 <= time < duration [s]: 10 s at 60 fps is 600. InputError beyond kMostFrames.
  std::int64_t frameCount(double duration) const;
  std::string text() const;  ///< "30", "24000/1001"

  friend bool operator==(const FrameRate&, const FrameRate&) = default;
};

inline constexpr double kSlowestFrameRate = 0.001;  ///< [1/s]
inline constexpr double kFastestFrameRate = 1e5;    ///< [1/s]
inline constexpr std::int64_t kMostFrames = 1'000'000'000;

/// "30", "24000/1001", "12.5"; 23.976, 29.97, 59.94 and 119.88 mean the broadcast rates n·1000/1001. Other
/// decimals are kept to a millionth. InputError otherwise, and outside kSlowestFrameRate … kFastestFrameRate.
FrameRate parseFrameRate(std::string_view text);
FrameRate frameRateFrom(double framesPerSecond);

}  // namespace careen
