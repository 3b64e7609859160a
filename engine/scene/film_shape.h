#pragma once

#include "scene/json_shape.h"
#include "scene/scene.h"

namespace careen {

/// The scene's camera and how it moves; whom it follows is found by checkScene.
void readCamera(const JsonValue& value, Scene& scene);
/// Its pictures, and which moments it shows.
void readFilm(const JsonValue& value, Scene& scene);

}  // namespace careen
