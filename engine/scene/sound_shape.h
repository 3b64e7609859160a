#pragma once

#include <optional>

#include "scene/json_shape.h"
#include "stage/sound_material.h"

namespace careen {

/// What the object's "material" sounds like: a name, or numbers; nothing if it has none.
std::optional<SoundMaterial> readSound(const JsonObject& object);

}  // namespace careen
