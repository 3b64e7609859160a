#pragma once

#include "scene/json_shape.h"
#include "scene/scene.h"

namespace careen {

/// Reads the scene's camera and its movement; checkScene finds the box that it follows.
void readCamera(const JsonValue& value, Scene& scene);
/// Reads the film's picture settings and the times it shows.
void readFilm(const JsonValue& value, Scene& scene);

}  // namespace careen
