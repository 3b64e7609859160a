#pragma once

#include <array>
#include <variant>

#include "physics/motion/flight.h"
#include "physics/world/body.h"
#include "physics/world/course.h"

namespace careen {

/// Nothing moves.
struct Rest {
  Pose pose;
};

/// One explicit Euler step of Listing 1 with open end: at time s into it, the body is where a step of length
/// s would have put it.
struct EulerStep {
  BodyState start;
  Vec3 force = Vec3::Zero();   ///< [N] total, at the start
  Vec3 torque = Vec3::Zero();  ///< [N m] total about the centre of mass, at the start
};

enum class Method : int;

/// Free flight by a stepping method: the centre of mass follows the parabola, the attitude results from steps
/// of dt and a last shorter one.
struct SteppedFlight {
  Method method{};
  double dt = 0;  ///< [s]
  Flight start;
};

/// One time step of contact stepping: degree-5 Hermite polynomials through position, velocity and
/// acceleration at both ends, whose error does not exceed that of the step.
struct ContactStep {
  double duration = 0;  ///< [s]
  /// [m] position at s = elapsed/duration: Σ position[k] sᵏ.
  std::array<Vec3, 6> position{};
  /// Quaternion x y z w likewise, not normalised.
  std::array<Vec4, 6> worldFromBody{};
};

/// Steps of a crowd's member, of bounded error: a cubic in place and attitude.
struct CrowdStep {
  double duration = 0;                  ///< [s]
  std::array<Vec3, 4> position{};       ///< [m] as in ContactStep
  std::array<Vec4, 4> worldFromBody{};  ///< likewise
};
ContactStep asContactStep(const CrowdStep& step);

Vec3 positionAt(const ContactStep& step, double elapsed);
Vec3 velocityAt(const ContactStep& step, double elapsed);
Quat attitudeAt(const ContactStep& step, double elapsed);
/// Upper bounds over a contact step.
using StepBounds = MotionRates;
StepBounds boundsOf(const ContactStep& step);

/// From one row of a table of poses to the next: its states at both ends, bit for bit. Between them positions
/// are cubic in time, with the velocities at the ends. So is the quaternion, with the angular velocities at
/// the ends, where these agree with the rotation from one end to the other; where they do not, as across an
/// impact or if the box turns by half a turn and more between two rows, it is linear.
struct SampledStep {
  double duration = 0;  ///< [s]
  BodyState start;
  BodyState end;
};

/// Motion of one body until its next event. To add a motion: one more type here, the last,
/// because files store its index, and one more stateIn in motion.cpp.
using Motion =
    std::variant<Rest, EulerStep, Flight, SteppedFlight, ContactStep, CrowdStep, SampledStep, Driven>;

/// State of the body `elapsed` [s] after the motion began.
BodyState stateAt(const Motion& motion, const MassProperties& mass, double elapsed);

}  // namespace careen
