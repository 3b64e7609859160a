#pragma once

#include <cstdint>
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

/// The most segments and impacts of a run unless more are asked for: 2 GB, three times that while they are
/// recorded.
inline constexpr std::uint64_t kMostRecords = 5'000'000;

}  // namespace careen
