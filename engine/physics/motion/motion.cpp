#include "physics/motion/motion.h"

#include <algorithm>
#include <cmath>

#include "core/math/to_integer.h"
#include "physics/attitude/free_methods.h"
#include "physics/attitude/torque_free_rotation.h"
#include "physics/motion/listing1.h"

namespace careen {
namespace {

BodyState stateIn(const Rest& rest, const MassProperties& /*mass*/, double /*elapsed*/) {
  return {.pose = rest.pose};
}

BodyState stateIn(const EulerStep& step, const MassProperties& mass, double elapsed) {
  // At its start bitwise the state itself: even a step of zero length would re-orthonormalise.
  return elapsed == 0 ? step.start
                      : listing1Step(mass, step.start, {.force = step.force, .torque = step.torque}, elapsed);
}

BodyState stateIn(const Flight& flight, const MassProperties& mass, double elapsed) {
  const TorqueFreeRotation<double> rotation(mass.inertiaBody, mass.worldFromPrincipal(flight.worldFromBody),
                                            flight.angularMomentum);
  return {.pose = {.position = flight.positionAt(elapsed),
                   .worldFromBody = mass.worldFromBody(rotation.worldFromBody(elapsed)).toRotationMatrix()},
          .velocity = flight.velocityAt(elapsed),
          .angularMomentum = flight.angularMomentum};
}

BodyState stateIn(const SteppedFlight& stepped, const MassProperties& mass, double elapsed) {
  const Flight& flight = stepped.start;
  const FreeMethod& method = freeMethod(stepped.method);
  const Quat principal = mass.worldFromPrincipal(flight.worldFromBody);
  FreeState<double> rotation{principal, principal.conjugate() * flight.angularMomentum};
  const double whole = std::floor(elapsed / stepped.dt);
  method.steps(mass.inertiaBody, rotation, stepped.dt, toInteger<std::int64_t>(whole, std::int64_t{0}));
  if (const double rest = elapsed - whole * stepped.dt; rest > 0) {
    method.steps(mass.inertiaBody, rotation, rest, 1);
  }
  return {.pose = {.position = flight.positionAt(elapsed),
                   .worldFromBody = mass.worldFromBody(rotation.worldFromBody).toRotationMatrix()},
          .velocity = flight.velocityAt(elapsed),
          .angularMomentum = rotation.angularMomentumWorld()};
}

// Σ c[k] sᵏ and its derivative with respect to s.
template <class Vector>
struct Polynomial {
  Vector value;
  Vector slope;
};
template <class Vector, std::size_t kCount>
Polynomial<Vector> evaluate(const std::array<Vector, kCount>& coefficients, double s) {
  constexpr std::size_t kLast = 5;
  // Of a cubic the coefficients beyond are 0, and not −0.
  Polynomial<Vector> at{Vector::Zero(), Vector::Zero()};
  if constexpr (kCount > kLast) {
    at.value = coefficients[kLast];
  }
  for (std::size_t k = std::min(kCount, kLast); k-- > 0;) {
    at.slope = at.slope * s + at.value;
    at.value = at.value * s + coefficients[k];
  }
  return at;
}

// The state of a body whose position and quaternion, of any length, are polynomials of elapsed/duration.
BodyState stateOf(const Polynomial<Vec3>& position, const Polynomial<Vec4>& turn, double duration,
                  const MassProperties& mass) {
  // ω = 2 q̇ q*, for a quaternion of any length.
  const Quat q(turn.value);
  const Quat rate(turn.slope);
  const Vec3 omega = (2 / (duration * turn.value.squaredNorm())) * (rate * q.conjugate()).vec();
  const Mat3 columns = q.normalized().toRotationMatrix();
  return {.pose = {.position = position.value, .worldFromBody = columns},
          .velocity = position.slope / duration,
          .angularMomentum = angularMomentum(mass, columns, omega)};
}

template <class Step>
BodyState stateWithin(const Step& step, const MassProperties& mass, double elapsed) {
  const double s = elapsed / step.duration;
  return stateOf(evaluate(step.position, s), evaluate(step.worldFromBody, s), step.duration, mass);
}

BodyState stateIn(const ContactStep& step, const MassProperties& mass, double elapsed) {
  return stateWithin(step, mass, elapsed);
}

BodyState stateIn(const CrowdStep& step, const MassProperties& mass, double elapsed) {
  return stateWithin(step, mass, elapsed);
}

BodyState stateIn(const Driven& driven, const MassProperties& /*mass*/, double elapsed) {
  return stateOf(driven.at(elapsed));
}

// Cubic Hermite interpolation between values `from` and `to` with slopes `rateFrom` and `rateTo`, by s.
template <class Vector>
Polynomial<Vector> cubic(const Vector& from, const Vector& rateFrom, const Vector& to, const Vector& rateTo,
                         double s) {
  const Vector way = to - from;
  return evaluate<Vector, 6>({from, rateFrom, 3 * way - 2 * rateFrom - rateTo, rateFrom + rateTo - 2 * way,
                              Vector::Zero(), Vector::Zero()},
                             s);
}

BodyState stateIn(const SampledStep& step, const MassProperties& mass, double elapsed) {
  if (elapsed <= 0 || elapsed >= step.duration) {
    return elapsed <= 0 ? step.start : step.end;
  }
  const double s = elapsed / step.duration;
  const Quat from(step.start.pose.worldFromBody);
  Quat to(step.end.pose.worldFromBody);
  if (dot(from, to) < 0) {
    to.coeffs() = -to.coeffs();
  }
  // q̇ = ½ ω q
  const auto rateOf = [&](const BodyState& state, const Quat& q) -> Vec4 {
    const Vec3 turn = 0.5 * step.duration * angularVelocity(mass, state);
    return (Quat(0, turn.x(), turn.y(), turn.z()) * q).coeffs();
  };
  const Vec4 chord = to.coeffs() - from.coeffs();
  Vec4 rateFrom = rateOf(step.start, from);
  Vec4 rateTo = rateOf(step.end, to);
  // The chord is at least √½ from zero; rates that differ from it bend the way by at most 4/27 of their
  // differences, so that the quaternion stays longer than ½.
  constexpr double kAgreeing = 1;
  if (!((rateFrom - chord).norm() + (rateTo - chord).norm() <= kAgreeing)) {
    rateFrom = chord;
    rateTo = chord;
  }
  return stateOf(cubic<Vec3>(step.start.pose.position, step.duration * step.start.velocity,
                             step.end.pose.position, step.duration * step.end.velocity, s),
                 cubic<Vec4>(from.coeffs(), rateFrom, to.coeffs(), rateTo, s), step.duration, mass);
}

}  // namespace

ContactStep asContactStep(const CrowdStep& step) {
  ContactStep full{.duration = step.duration};
  full.position.fill(Vec3::Zero());
  full.worldFromBody.fill(Vec4::Zero());
  std::copy(step.position.begin(), step.position.end(), full.position.begin());
  std::copy(step.worldFromBody.begin(), step.worldFromBody.end(), full.worldFromBody.begin());
  return full;
}

Vec3 positionAt(const ContactStep& step, double elapsed) {
  return evaluate(step.position, elapsed / step.duration).value;
}

Vec3 velocityAt(const ContactStep& step, double elapsed) {
  return evaluate(step.position, elapsed / step.duration).slope / step.duration;
}

Quat attitudeAt(const ContactStep& step, double elapsed) {
  return Quat(evaluate(step.worldFromBody, elapsed / step.duration).value).normalized();
}

StepBounds boundsOf(const ContactStep& step) {
  StepBounds bounds;
  for (std::size_t k = 1; k < step.position.size(); ++k) {
    const double first = static_cast<double>(k) / step.duration;
    const double second = first * static_cast<double>(k - 1) / step.duration;
    bounds.speed += first * step.position[k].norm();
    bounds.acceleration += second * step.position[k].norm();
    bounds.angularSpeed += 2 * first * step.worldFromBody[k].norm();
    bounds.angularAcceleration += 2 * second * step.worldFromBody[k].norm();
  }
  // Between the ends the quaternion's length is not exactly 1.
  constexpr double kLength = 1 + 0x1p-6;
  bounds.angularSpeed *= kLength;
  bounds.angularAcceleration =
      kLength * (bounds.angularAcceleration + bounds.angularSpeed * bounds.angularSpeed);
  return bounds;
}

BodyState stateAt(const Motion& motion, const MassProperties& mass, double elapsed) {
  return std::visit([&](const auto& kind) { return stateIn(kind, mass, elapsed); }, motion);
}

}  // namespace careen
