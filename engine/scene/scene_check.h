#pragma once

#include "scene/json_tree.h"
#include "scene/scene.h"
#include "scene/starts.h"

namespace careen {

/// Second half of reading a scene: what its values say about each other. Finds the boxes that springs and
/// the camera name; names are unique among boxes and walls, room walls included; the film can be made
/// (film_check.h); every box starts on the free side of every wall and, where boxes meet, outside every
/// other, but for kGapAllowance; unless they may overlap. InputError at the place in `tree`, which the scene
/// was read from.
void checkScene(const JsonTree& tree, Scene& scene, Starts starts = Starts::kApart);

}  // namespace careen
