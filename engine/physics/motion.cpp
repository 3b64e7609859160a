#include "physics/motion.h"

#include <cmath>

#include "physics/free_methods.h"
#include "physics/listing1.h"
#include "physics/torque_free_rotation.h"

namespace careen {
namespace {

BodyState stateIn(const Rest& rest, const MassProperties& /*mass*/, double /*elapsed*/) {
  return {.pose = rest.pose};
}

BodyState stateIn(const EulerStep& step, const MassProperties& mass, double elapsed) {
  // At its start the state itself, to the bit: even a step of no length would orthonormalise anew.
  return elapsed == 0 ? step.start
                      : listing1Step(mass, step.start, {.force = step.force, .torque = step.torque}, elapsed);
}

BodyState stateIn(const Flight& flight, const MassProperties& mass, double elapsed) {
  const TorqueFreeRotation<double> rotation(mass.inertiaBody, flight.worldFromBody, flight.angularMomentum);
  return {.pose = {.position = flight.positionAt(elapsed),
                   .worldFromBody = rotation.worldFromBody(elapsed).toRotationMatrix()},
          .velocity = flight.velocityAt(elapsed),
          .angularMomentum = flight.angularMomentum};
}

BodyState stateIn(const SteppedFlight& stepped, const MassProperties& mass, double elapsed) {
  const Flight& flight = stepped.start;
  const FreeMethod& method = freeMethod(stepped.method);
  FreeState<double> rotation{flight.worldFromBody, flight.worldFromBody.conjugate() * flight.angularMomentum};
  const double whole = std::floor(elapsed / stepped.dt);
  method.steps(mass.inertiaBody, rotation, stepped.dt, static_cast<std::int64_t>(whole));
  if (const double rest = elapsed - whole * stepped.dt; rest > 0) {
    method.steps(mass.inertiaBody, rotation, rest, 1);
  }
  return {.pose = {.position = flight.positionAt(elapsed),
                   .worldFromBody = rotation.worldFromBody.toRotationMatrix()},
          .velocity = flight.velocityAt(elapsed),
          .angularMomentum = rotation.angularMomentumWorld()};
}

}  // namespace

BodyState stateAt(const Motion& motion, const MassProperties& mass, double elapsed) {
  return std::visit([&](const auto& kind) { return stateIn(kind, mass, elapsed); }, motion);
}

}  // namespace careen
