#pragma once

#include <string>

#include "physics/world/plan.h"
#include "physics/world/run_settings.h"
#include "physics/world/world.h"
#include "stage/stage.h"

namespace careen {

/// What a run starts from, made once from a scene: all that is needed to simulate it and to draw and measure
/// the result.
struct RunSetup {
  std::string sceneText;  ///< the scene file, byte for byte: the run's origin, not needed to show it
  RunSettings settings;
  World world;  ///< as simulated
  Stage stage;
  Plan plan;
};

}  // namespace careen
