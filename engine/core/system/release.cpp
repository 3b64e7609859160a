#include "core/system/release.h"

#if __has_include(<gnu/libc-version.h>)
#include <gnu/libc-version.h>
#endif

#include <charconv>
#include <fstream>
#include <sstream>
#include <string>

namespace careen {

std::string_view drawingPackages(std::string_view osRelease) {
  constexpr int kLastWithOsMesa = 13;
  constexpr std::string_view kKey = "VERSION_ID=";
  int release = kLastWithOsMesa + 1;
  std::istringstream lines{std::string(osRelease)};
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(kKey)) {
      const char* const value = line.c_str() + kKey.size();
      std::from_chars(*value == '"' ? value + 1 : value, line.c_str() + line.size(), release);
    }
  }
  return release <= kLastWithOsMesa ? "libosmesa6" : "libegl1 libegl-mesa0 libgl1-mesa-dri";
}

std::string_view drawingPackages() {
  std::stringstream text;
  text << std::ifstream("/etc/os-release").rdbuf();
  return drawingPackages(text.str());
}

std::string cLibrary() {
#if __has_include(<gnu/libc-version.h>)
  return std::string("glibc ") + gnu_get_libc_version();
#else
  return "musl";
#endif
}

}  // namespace careen
