#pragma once

#include "scene/box_names.h"
#include "scene/json_tree.h"
#include "scene/scene.h"

namespace careen {

/// Finds the boxes that a scene's camera names, and checks what the scene says of how it is shown: the camera
/// looks somewhere, keys are in order, the film shows no time after the end of the run, titles last.
/// InputError at the place in `tree`.
void checkShown(const JsonTree& tree, const BoxNames& boxes, Scene& scene);

}  // namespace careen
