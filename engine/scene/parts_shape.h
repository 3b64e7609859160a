#pragma once

#include <vector>

#include "physics/world/body.h"
#include "scene/json_shape.h"

namespace careen {

/// [1] A rotation: a quaternion, or an axis and an angle.
Mat3 readOrientation(const JsonValue& value);

/// The boxes that a body consists of, in its frame.
std::vector<BodyPart> readParts(const JsonValue& value);

}  // namespace careen
