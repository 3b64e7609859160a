#pragma once

#include "exchange/mjcf_model.h"

namespace careen {

/// Poses and velocities of the bodies that move: of the key frame "start" if there is one, else as the model
/// stands, at rest. InputError if the key frame has other numbers than the joints have coordinates, or if a
/// coordinate is where a joint of a scene cannot start.
void readStart(MjcfDocument& document, MjcfModel& model);

}  // namespace careen
