#pragma once

#include "physics/world/control.h"
#include "scene/json_shape.h"

namespace careen {

/// A control with the motors of a scene file; which joints they are of is found by connectMotors().
Control readControl(const JsonValue& value);

}  // namespace careen
