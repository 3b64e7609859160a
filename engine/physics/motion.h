#pragma once

#include <variant>

#include "physics/body.h"
#include "physics/flight.h"

namespace careen {

/// Nothing moves.
struct Rest {
  Pose pose;
};

/// One explicit Euler step of Listing 1, left open at its end: at time s into it, the body is where a step of
/// length s would have put it.
struct EulerStep {
  BodyState start;
  Vec3 force = Vec3::Zero();   ///< [N] total, at the start
  Vec3 torque = Vec3::Zero();  ///< [N m] total about the centre of mass, at the start
};

enum class Method : int;

/// Free flight by a method that steps: the centre of mass runs along the parabola, the attitude is what steps
/// of dt and a last shorter one lead to.
struct SteppedFlight {
  Method method{};
  double dt = 0;  ///< [s]
  Flight start;
};

/// How one body moves until something happens to it. A further motion is one more type here and one more line
/// in stateAt.
using Motion = std::variant<Rest, EulerStep, Flight, SteppedFlight>;

/// Where the body is `elapsed` [s] after the motion began.
BodyState stateAt(const Motion& motion, const MassProperties& mass, double elapsed);

}  // namespace careen
