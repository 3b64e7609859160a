#pragma once

#include <optional>

#include "physics/world/course.h"
#include "scene/json_shape.h"

namespace careen {

/// Whether the value of "motion" tells the place.
bool hasPath(const JsonValue& motion);
/// How a fixed box or a wall moves by itself: that value, of what is at that pose but for its path and its
/// oscillation. `position`: what the scene says of its place, if it does.
Course readMotion(const JsonValue& motion, const std::optional<JsonValue>& position, const Pose& pose);

}  // namespace careen
