#pragma once

#include "scene/json_tree.h"
#include "scene/scene.h"

namespace careen {

/// What the values of a scene's camera and film say about each other: the camera looks somewhere, keys are in
/// order, the film shows no moment after the run's end. InputError at the place in `tree`.
void checkFilm(const JsonTree& tree, const Scene& scene);

}  // namespace careen
