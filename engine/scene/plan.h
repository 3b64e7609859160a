#pragma once

#include "physics/world/plan.h"
#include "physics/world/world.h"
#include "scene/scene.h"
#include "stage/run_setup.h"
#include "stage/stage.h"

namespace careen {

/// What the scene's physics calls for, and what its method has of it.
Plan plan(const Scene& scene);

/// The world with what the plan models, and nothing else: what is left out is never executed. Bodies are in
/// the order of the scene's boxes; fixed ones are immovable. Whether boxes start apart is not asked here: the
/// reader has done so for the scene's own method, see checkApart for another one.
World assemble(const Scene& scene, const Plan& plan);

RunSettings settingsOf(const Scene& scene);

/// What of the scene is to be seen, and how.
Stage stageOf(const Scene& scene);

/// Plan, world and stage of the scene, and its settings: all that a run takes of it.
RunSetup setupOf(const Scene& scene);

}  // namespace careen
