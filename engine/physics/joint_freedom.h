#pragma once

#include "physics/world/world.h"

namespace careen {

/// What joints leave to the bodies that they hold, at the start of a run. Limits, ropes and dry friction
/// leave all of it.
struct JointFreedom {
  int bodies = 0;     ///< that can move and have a joint
  int degrees = 0;    ///< of freedom, of all of them: 6 each, less the rank of the joints' rows
  int rows = 0;       ///< conditions of joints that hold
  int redundant = 0;  ///< of these: they follow from the others
};

JointFreedom jointFreedom(const World& world);

}  // namespace careen
