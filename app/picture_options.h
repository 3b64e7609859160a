#pragma once

#include <optional>
#include <string>

#include "core/error.h"
#include "render/gl/rendering_backend.h"
#include "stage/picture_settings.h"

namespace CLI {
class App;
}

namespace careen {

/// What the command line puts in place of what the scene says of its film's pictures, and what draws them.
struct PictureOptions {
  std::optional<std::string> size;
  std::optional<std::string> rate;
  std::optional<std::string> shutter;
  std::optional<std::string> overlays;
  std::optional<std::string> look;
  std::optional<std::string> antialiasing;
  std::string backend = "auto";
  ContextOptions context;

  void addTo(CLI::App& command);

  /// Puts what is given in place of the picture's own.
  void applyTo(PictureSettings& picture) const;
  ContextOptions contextOptions() const;
  /// InputError: all that can be found wrong before anything is simulated.
  void check() const;
};

}  // namespace careen
