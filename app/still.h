#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/error.h"
#include "render/draw/renderer.h"
#include "run.h"

namespace careen {

/// One picture in place of a film.
struct Still {
  std::filesystem::path path;         ///< empty: out/ and the scene's name
  double moment = 0;                  ///< [s] of the film
  std::optional<std::string> strobe;  ///< FROM:TO:STEP, in place of the moment
};

/// Writes the picture and says where it is.
ExitCode drawStill(const Run& run, RenderOptions options, const Still& still);

}  // namespace careen
