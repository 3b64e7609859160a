#pragma once

#include "physics/world/plan.h"
#include "physics/world/run_settings.h"
#include "physics/world/world.h"
#include "scene/scene.h"
#include "stage/run_setup.h"
#include "stage/stage.h"

namespace careen {

/// Which physics the scene needs, and which of it the scene's method models.
Plan plan(const Scene& scene);

/// The world with what the plan models and nothing else: what is left out is never executed. Bodies are in
/// the order of the scene's boxes; fixed ones are immovable. Does not check that boxes start apart: the
/// reader has done so for the scene's own method; for another method see checkApart.
World assemble(const Scene& scene, const Plan& plan);

/// What is drawn of the scene, and how.
Stage stageOf(const Scene& scene);

/// Plan, world, stage and settings of the scene: all that a run needs of it.
RunSetup setupOf(const Scene& scene);

}  // namespace careen
