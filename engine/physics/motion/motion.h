#pragma once

#include <array>
#include <variant>

#include "physics/motion/flight.h"
#include "physics/world/body.h"

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

/// One step of the motion Contact: polynomials of degree 5 through place, velocity and acceleration at both
/// ends (Hermite), which err no more than the step does.
struct ContactStep {
  double duration = 0;  ///< [s]
  /// [m] position at s = elapsed/duration: Σ position[k] sᵏ.
  std::array<Vec3, 6> position{};
  /// Quaternion x y z w likewise, up to its length.
  std::array<Vec4, 6> worldFromBody{};
};

Vec3 positionAt(const ContactStep& step, double elapsed);
Vec3 velocityAt(const ContactStep& step, double elapsed);
/// What a step of Contact never exceeds.
struct StepBounds {
  double speed = 0;                ///< [m/s] of the centre
  double acceleration = 0;         ///< [m/s²] likewise
  double angularSpeed = 0;         ///< [rad/s]
  double angularAcceleration = 0;  ///< [rad/s²]
};
StepBounds boundsOf(const ContactStep& step);

/// How one body moves until something happens to it. A further motion is one more type here and one more line
/// in stateAt.
using Motion = std::variant<Rest, EulerStep, Flight, SteppedFlight, ContactStep>;

/// Where the body is `elapsed` [s] after the motion began.
BodyState stateAt(const Motion& motion, const MassProperties& mass, double elapsed);

}  // namespace careen
