#pragma once

#include <optional>
#include <string>

#include "core/error.h"
#include "picture_size.h"
#include "render/gl/rendering_backend.h"
#include "stage/picture_settings.h"

namespace careen {

class CommandLine;

/// Command-line options that override the scene's picture settings, and the rendering backend.
struct PictureOptions : SizeAndRate {
  std::optional<std::string> shutter;
  std::optional<std::string> overlays;
  std::optional<std::string> look;
  std::optional<std::string> light;
  std::optional<std::string> antialiasing;
  std::string backend = "auto";
  ContextOptions context;

  /// Returns the one of motion blur.
  CommandOption addTo(const CommandLine& command);

  /// Overrides the picture's settings with those that were given.
  void applyTo(PictureSettings& picture) const;
  ContextOptions contextOptions() const;
  /// InputError for everything that can be found wrong before the simulation.
  void check() const;
};

}  // namespace careen
