#pragma once

#include "physics/exact/bodies.h"
#include "physics/pile/crowd.h"

namespace careen {

/// [s] From that time on, until the first of a crowd's joints lets go or its motor may change.
double untilChange(const Bodies& bodies, Crowd& crowd, const Instant& time);
/// [J] That motors did in its last step; drives at the most. No hinge turns by half a turn in one.
double workOfMotors(Crowd& crowd);

}  // namespace careen
