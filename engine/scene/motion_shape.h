#pragma once

#include <optional>

#include "physics/world/course.h"
#include "scene/json_shape.h"

namespace careen {

/// How a fixed box moves by itself: the value of "motion", of a box that is at that pose but for its path and
/// its oscillation. `position`: what the scene says of its place, if it does.
Course readMotion(const JsonValue& motion, const std::optional<JsonValue>& position, const Pose& pose);

}  // namespace careen
