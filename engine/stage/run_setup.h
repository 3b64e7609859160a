#pragma once

#include <string>

#include "physics/world/method.h"
#include "physics/world/plan.h"
#include "physics/world/world.h"
#include "stage/stage.h"

namespace careen {

/// What a run starts from, made of a scene once: all that it takes to simulate it, and to draw and measure
/// what came of it.
struct RunSetup {
  std::string sceneText;  ///< the scene file, byte for byte: where the run came from, not needed to show it
  RunSettings settings;
  World world;  ///< as simulated
  Stage stage;
  Plan plan;
};

}  // namespace careen
