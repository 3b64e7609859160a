#pragma once

#include <filesystem>
#include <vector>

#include "core/error.h"
#include "render/draw/renderer.h"
#include "render/film/film_pictures.h"
#include "run_options.h"

namespace careen {

/// One picture instead of a film.
struct Still {
  std::filesystem::path path;   ///< empty: in out/, named after the scene
  std::vector<double> moments;  ///< [s] of the film: one, or many in one picture
  ShownBesides besides = {};    ///< of one moment
};

/// Writes the picture and prints its path.
ExitCode drawStill(const Run& run, const RenderOptions& options, const Still& still);

}  // namespace careen
