#include "film/frame_range.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <numeric>

#include "core/error.h"

namespace careen {
namespace {

[[noreturn]] void fail(std::string_view found) {
  throw InputError("frames: found '" + std::string(found) + "', expected ranges such as 0-119,200:2");
}

std::int64_t number(std::string_view text, std::string_view range) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 0) {
    fail(range);
  }
  return value;
}

FrameRange parseRange(std::string_view text) {
  FrameRange range;
  const std::size_t colon = text.find(':');
  const std::string_view ends = text.substr(0, colon);
  const std::size_t dash = ends.find('-');
  range.first = number(ends.substr(0, dash), text);
  if (colon != std::string_view::npos) {
    range.step = number(text.substr(colon + 1), text);
  }
  if (dash != std::string_view::npos) {
    range.last = number(ends.substr(dash + 1), text);
  } else if (colon == std::string_view::npos) {
    range.last = range.first;
  }
  if (range.step < 1 || (range.last && *range.last < range.first)) {
    fail(text);
  }
  return range;
}

void checkCount(std::int64_t count) {
  if (count > kMostFramesNamed) {
    throw InputError("frames: found " + std::to_string(count) + " frames, expected at most " +
                     std::to_string(kMostFramesNamed) + " at once, such as --frames 0-" +
                     std::to_string(kMostFramesNamed - 1));
  }
}

void append(std::vector<std::int64_t>& frames, const FrameRange& range, std::int64_t frameCount) {
  const std::int64_t last = range.last.value_or(frameCount - 1);
  if (range.first >= frameCount || last >= frameCount) {
    throw InputError("frames: found " + std::to_string(std::max(range.first, last)) +
                     ", expected frames from 0 to " + std::to_string(frameCount - 1));
  }
  checkCount(std::ssize(frames) + 1 + (last - range.first) / range.step);
  // Counts down the rest, because frame + step may overflow.
  for (std::int64_t left = last - range.first;; left -= range.step) {
    frames.push_back(last - left);
    if (left < range.step) {
      return;
    }
  }
}

}  // namespace

std::vector<FrameRange> parseFrameRanges(std::string_view text) {
  std::vector<FrameRange> ranges;
  while (true) {
    const std::size_t comma = text.find(',');
    ranges.push_back(parseRange(text.substr(0, comma)));
    if (comma == std::string_view::npos) {
      return ranges;
    }
    text.remove_prefix(comma + 1);
  }
}

std::vector<std::int64_t> framesOf(std::span<const FrameRange> ranges, std::int64_t frameCount) {
  std::vector<std::int64_t> frames;
  if (ranges.empty()) {
    checkCount(frameCount);
    frames.resize(static_cast<std::size_t>(frameCount));
    std::iota(frames.begin(), frames.end(), 0);
  }
  for (const FrameRange& range : ranges) {
    append(frames, range, frameCount);
  }
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

std::string rangesText(std::span<const std::int64_t> frames) {
  std::string text;
  for (std::size_t first = 0; first < frames.size();) {
    std::size_t last = first;
    while (last + 1 < frames.size() && frames[last + 1] == frames[last] + 1) {
      ++last;
    }
    text += (text.empty() ? "" : ",") + std::to_string(frames[first]);
    if (last > first) {
      text += "-" + std::to_string(frames[last]);
    }
    first = last + 1;
  }
  return text;
}

}  // namespace careen
