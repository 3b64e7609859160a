#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "render/draw/renderer.h"
#include "run.h"

namespace careen {

/// One picture instead of a film.
struct Still {
  std::filesystem::path path;                  ///< empty: in out/, named after the scene
  double moment = 0;                           ///< [s] of the film
  std::optional<std::string> strobe;           ///< FROM:TO:STEP, instead of one time
  std::vector<const Trajectory*> beside = {};  ///< other runs, shown beside it, except in a strobe
  const Trajectory* ghost = nullptr;           ///< shown as outlines, except in a strobe
};

/// Writes the picture and prints its path.
ExitCode drawStill(const Run& run, const RenderOptions& options, const Still& still);

}  // namespace careen
