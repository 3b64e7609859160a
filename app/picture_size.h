#pragma once

#include <optional>
#include <string>
#include <utility>

#include "stage/picture_settings.h"

namespace careen {

class CommandLine;

/// "1280x720": width and height [px]. InputError otherwise.
std::pair<int, int> parseSize(const std::string& text);

/// Command-line options of everything that makes frames: their size and rate in place of the scene's.
struct SizeAndRate {
  std::optional<std::string> size;
  std::optional<std::string> rate;

  void addTo(const CommandLine& command);
  /// InputError for what is no size or rate.
  void applyTo(PictureSettings& picture) const;
};

}  // namespace careen
