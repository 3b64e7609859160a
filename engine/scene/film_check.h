#pragma once

#include "scene/json_tree.h"
#include "scene/scene.h"

namespace careen {

/// Checks the values of a scene's camera and film against each other: the camera looks somewhere, keys are
/// in order, and the film shows no time after the end of the run. InputError at the place in `tree`.
void checkFilm(const JsonTree& tree, const Scene& scene);

}  // namespace careen
