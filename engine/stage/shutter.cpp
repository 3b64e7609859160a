#include "stage/shutter.h"

#include <charconv>

#include "core/brief.h"
#include "core/error.h"

namespace careen {
namespace {

template <class Number>
bool isWhole(std::string_view text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

std::string Shutter::text() const {
  if (!(degrees > 0)) {
    return "none";
  }
  return inFull(degrees) + ":" + std::to_string(samples);
}

Shutter parseShutter(std::string_view text) {
  Shutter shutter;
  const std::size_t colon = text.find(':');
  const bool good = isWhole(text.substr(0, colon), shutter.degrees) && shutter.degrees >= 0 &&
                    shutter.degrees <= kWidestShutter &&
                    (colon == std::string_view::npos || isWhole(text.substr(colon + 1), shutter.samples)) &&
                    shutter.samples >= 1 && shutter.samples <= kMostShutterSamples;
  if (!good) {
    throw InputError("found '" + std::string(text) +
                     "', expected an angle from 0 to 360 [deg], and from 1 to 256 samples if so wished, such "
                     "as 180:8");
  }
  return shutter;
}

}  // namespace careen
