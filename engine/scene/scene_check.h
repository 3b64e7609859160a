#pragma once

#include "scene/json_tree.h"
#include "scene/scene.h"

namespace careen {

/// Second half of reading a scene: what its values say about each other. Finds the boxes that springs name;
/// names are unique among boxes and walls, room walls included; the camera looks somewhere; every box starts
/// on the free side of every wall, but for kGapAllowance. Boxes may overlap: no method has contact between
/// boxes. InputError at the place in `tree`, which the scene was read from.
void checkScene(const JsonTree& tree, Scene& scene);

/// How deep in a wall a box may start, for rounding's sake: this much of the lengths its gap is the
/// difference of.
inline constexpr double kGapAllowance = 1e-12;

}  // namespace careen
