#pragma once

#include "scene/json_shape.h"
#include "scene/scene.h"

namespace careen {

/// Reads how a scene is shown: its camera and how that moves, the film's pictures and the times it shows,
/// look, light, and what is drawn over it. checkShown finds the boxes that are named.
void readShown(const JsonObject& object, Scene& scene);

}  // namespace careen
