#include "picture_size.h"

#include <charconv>
#include <tuple>

#include "command_line.h"
#include "core/error.h"
#include "parsed.h"

namespace careen {

std::pair<int, int> parseSize(const std::string& text) {
  int width = 0;
  int height = 0;
  const char* const end = text.data() + text.size();
  const std::from_chars_result first = std::from_chars(text.data(), end, width);
  if (first.ec == std::errc() && first.ptr != end && *first.ptr == 'x') {
    const std::from_chars_result second = std::from_chars(first.ptr + 1, end, height);
    if (second.ec == std::errc() && second.ptr == end && width > 0 && height > 0 && width <= kLargestFilm &&
        height <= kLargestFilm) {
      return {width, height};
    }
  }
  throw InputError("--size: found '" + text + "', expected WIDTHxHEIGHT, each from 1 to " +
                   std::to_string(kLargestFilm) + ", such as 1280x720");
}

void SizeAndRate::addTo(const CommandLine& command) {
  command.add("--size", size, "WIDTHxHEIGHT in place of the scene's [px]");
  command.add("--fps", rate, "Frames per second in place of the scene's, such as 25 or 24000/1001");
}

void SizeAndRate::applyTo(PictureSettings& picture) const {
  if (size) {
    std::tie(picture.width, picture.height) = parseSize(*size);
  }
  if (rate) {
    picture.rate = parsed("--fps", *rate, parseFrameRate);
  }
}

}  // namespace careen
