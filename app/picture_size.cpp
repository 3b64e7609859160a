#include "picture_size.h"

#include <charconv>

#include "core/error.h"
#include "stage/picture_settings.h"

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

}  // namespace careen
