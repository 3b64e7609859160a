#include "core/system/release.h"

#include <charconv>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>

namespace careen {

std::string_view drawingPackages(std::string_view osRelease) {
  constexpr int kLastWithOsMesa = 13;
  constexpr std::string_view kKey = "\nVERSION_ID=";
  const std::string text = "\n" + std::string(osRelease);
  int release = kLastWithOsMesa + 1;
  if (const std::size_t at = text.find(kKey); at != std::string::npos) {
    const char* const begin = text.c_str() + at + kKey.size();
    std::from_chars(*begin == '"' ? begin + 1 : begin, text.c_str() + text.size(), release);
  }
  return release <= kLastWithOsMesa ? "libosmesa6" : "libegl1 libegl-mesa0 libgl1-mesa-dri";
}

std::string_view drawingPackages() {
  std::stringstream text;
  text << std::ifstream("/etc/os-release").rdbuf();
  return drawingPackages(text.str());
}

}  // namespace careen
