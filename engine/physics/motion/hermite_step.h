#pragma once

#include "core/math/linear_algebra.h"
#include "physics/motion/motion.h"

namespace careen {

/// One end of a contact step: place, velocity and acceleration of a body.
struct StepEnd {
  Vec3 position = Vec3::Zero();      ///< [m]
  Vec3 velocity = Vec3::Zero();      ///< [m/s]
  Vec3 acceleration = Vec3::Zero();  ///< [m/s²]
  Quat worldFromBody = Quat::Identity();
  Vec3 spinBody = Vec3::Zero();      ///< [rad/s] body frame
  Vec3 spinRateBody = Vec3::Zero();  ///< [rad/s²] body frame
};

/// The polynomials of degree 5 through both ends of a step of `length` [s].
ContactStep hermiteStep(const StepEnd& from, const StepEnd& to, double length);

/// The polynomials of degree 3, which leave the accelerations free.
CrowdStep cubicStep(const StepEnd& from, const StepEnd& to, double length);

/// Where the body is `elapsed` [s] after the step began, its accelerations left out.
StepEnd endWithin(const CrowdStep& step, double elapsed);

}  // namespace careen
