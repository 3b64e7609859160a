#pragma once

#include "scene/json_tree.h"
#include "scene/scene.h"

namespace careen {

/// Gives boxes with `mass_from` the mass and the inertia of their mesh at their density. Files are looked for
/// beside the scene's. The mesh lies in the box's frame and within the box, its centre of mass at the box's
/// centre and its principal axes along the box's, all to kFitsBox of the half diagonal: a box that turns
/// about another point or other axes is not modelled. InputError otherwise, and where mass_from stands
/// without density, beside mass or inertia, or in a fixed box.
void takeMassesFromMeshes(const JsonTree& tree, Scene& scene);

inline constexpr double kFitsBox = 1e-6;

}  // namespace careen
