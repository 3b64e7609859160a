#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/error.h"
#include "render/draw/renderer.h"
#include "render/film/film_pictures.h"
#include "run.h"

namespace careen {

/// One picture instead of a film.
struct Still {
  std::filesystem::path path;         ///< empty: in out/, named after the scene
  double moment = 0;                  ///< [s] of the film
  std::optional<std::string> strobe;  ///< FROM:TO:STEP, instead of one time
  ShownBesides besides = {};          ///< nothing in a strobe
};

/// Writes the picture and prints its path.
ExitCode drawStill(const Run& run, const RenderOptions& options, const Still& still);

}  // namespace careen
