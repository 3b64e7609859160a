#pragma once

#include "scene/json_tree.h"
#include "scene/scene.h"

namespace careen {

/// Gives boxes with `mass_from` the mass, centre of mass and inertia of their mesh at their density. Files
/// are looked for beside the scene's. Gives its centre of mass too. The mesh lies in the box's frame and
/// within the box, to kFitsBox of the half diagonal; where its centre of mass is the box's middle, or its
/// principal axes the box's, to kFitsBox likewise, they are taken to be that. InputError otherwise, and where
/// mass_from stands without density, beside mass, inertia or center, or in a fixed box.
void takeMassesFromMeshes(const JsonTree& tree, Scene& scene);

/// Reads the meshes that boxes are drawn as: closed, and within their boxes, as above, else InputError.
void takeDrawnMeshes(const JsonTree& tree, Scene& scene);

inline constexpr double kFitsBox = 1e-6;

}  // namespace careen
