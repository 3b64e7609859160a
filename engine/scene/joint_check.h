#pragma once

#include "scene/box_names.h"
#include "scene/json_tree.h"
#include "scene/scene.h"

namespace careen {

/// Gives the scene's joints their boxes, with ends in frames of these and the box that is not the world
/// first; lists the boxes that pass through each other. InputError at the place in `tree`, from which the
/// scene was read, if a joint is none: see assets/manual/joints.md.
/// The joints of the scene's motors, by name. InputError at names of none, and of joints without a
/// coordinate, and at a period that is too short for the scene's duration.
void connectMotors(const JsonTree& tree, Scene& scene);

void connectJoints(const JsonTree& tree, const BoxNames& boxes, Scene& scene);

}  // namespace careen
