#pragma once

#include <optional>
#include <string>

#include "command_line.h"
#include "core/error.h"
#include "picture_size.h"
#include "render/gl/rendering_backend.h"
#include "stage/picture_settings.h"

namespace careen {

/// Command-line options that override the scene's picture settings, and the rendering backend.
struct PictureOptions : SizeAndRate {
  std::optional<std::string> shutter;
  std::optional<std::string> overlays;
  std::optional<std::string> look;
  std::optional<std::string> light;
  std::optional<std::string> antialiasing;
  bool alpha = false;  ///< no option of addTo: not every command makes pictures to lay over others
  std::string backend = "auto";
  ContextOptions context;

  void addTo(const CommandLine& command);

  /// Overrides the picture's settings with those that were given.
  void applyTo(PictureSettings& picture) const;
  /// Whether the backends are to be told, and no film is to be made.
  bool listsBackends() const;
  ContextOptions contextOptions() const;
  /// As many as may draw; none of its own is one.
  std::optional<int> threadsOfCrowds() const;
  /// InputError for everything that can be found wrong before the simulation.
  void check() const;
};

}  // namespace careen
