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
  std::optional<std::int64_t> last;  ///< absent: the film's end
  std::int64_t step = 1;
};

/// "0-119,200:2": comma between ranges; a range is "a", "a-b", "a-b:step" or "a:step", which goes on to the
/// film's end. InputError otherwise.
std::vector<FrameRange> parseFrameRanges(std::string_view text);

/// The frames meant, in order, each once; all of them if there are no ranges. InputError if the film has not
/// all of them.
std::vector<std::int64_t> framesOf(std::span<const FrameRange> ranges, std::int64_t frameCount);

/// Frames in order as ranges, shortest form: "0-119,200".
std::string rangesText(std::span<const std::int64_t> frames);

}  // namespace careen
