#pragma once

#include <cstddef>

#include "physics/world/joint.h"
#include "scene/json_shape.h"

namespace careen {

/// A joint of the list, whose ends are not yet those of boxes: points and axes are as the scene gives them,
/// in the world at the start, but for the points of a rod or rope. A length of 0 is none given.
Joint readJoint(const JsonValue& value, std::size_t index);

/// Checks that it is a list of two names or more.
void readPassThrough(const JsonValue& value);

}  // namespace careen
