#pragma once

#include <optional>
#include <string>

#include "core/error.h"
#include "render/film/film.h"
#include "scene/scene.h"

namespace CLI {
class App;
}

namespace careen {

/// What the command line puts in place of what the scene says of its film's pictures.
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

  /// What the options alone say. InputError: all that can be found wrong before anything is simulated.
  FilmSettings settings() const;
  /// What they left open.
  void takeFromScene(const Scene& scene, FilmSettings& settings) const;
};

}  // namespace careen
