#pragma once

#include "scene/json_tree.h"
#include "scene/scene.h"
#include "scene/starts.h"

namespace careen {

/// Second half of reading a scene: checks its values against each other. Resolves the boxes named by springs,
/// joints and the camera; names must be unique among boxes and walls, room walls included; the film must be
/// possible (film_check.h); unless overlap is allowed, every box must start on the free side of every wall
/// and, if boxes collide, outside every other box, to within kGapAllowance. InputError at the place in
/// `tree`, from which the scene was read.
void checkScene(const JsonTree& tree, Scene& scene, Starts starts = Starts::kApart);

}  // namespace careen
