#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace careen {

/// Frames first, first + step, … up to and including last.
struct FrameRange {
  std::int64_t first = 0;
  std::optional<std::int64_t> last;  ///< absent: the last frame of the film
  std::int64_t step = 1;
};

/// "0-119,200:2": ranges separated by commas; a range is "a", "a-b", "a-b:step" or "a:step" (to the last
/// frame of the film). InputError otherwise.
std::vector<FrameRange> parseFrameRanges(std::string_view text);

/// The most frames that may be named at once, repeated ones counted again: 80 MB of numbers. At 30 frames per
/// second they are four days of film.
inline constexpr std::int64_t kMostFramesNamed = 10'000'000;

/// The frames of the ranges, sorted and without duplicates; all frames if there are no ranges. InputError if
/// a frame is outside the film, or if they are more than kMostFramesNamed.
std::vector<std::int64_t> framesOf(std::span<const FrameRange> ranges, std::int64_t frameCount);

/// Sorted frames as ranges in the shortest form: "0-119,200".
std::string rangesText(std::span<const std::int64_t> frames);

}  // namespace careen
