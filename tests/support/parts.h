#pragma once

#include "physics/world/body.h"
#include "physics/world/given_inertia.h"

namespace careen::test {

/// The same body, its box turned in its frame.
inline Body turnedIn(Body body, const Mat3& bodyFromPart) {
  const Mat3 tensor = bodyFromPart * body.mass.inertiaTensor() * bodyFromPart.transpose();
  const Vec3 spin = angularVelocity(body.mass, body.initial);
  body.mass = massWithTensor(body.mass.mass, 0.5 * (tensor + tensor.transpose()));
  body.initial.pose.worldFromBody = body.initial.pose.worldFromBody * bodyFromPart.transpose();
  body.initial.angularMomentum = angularMomentum(body.mass, body.initial.pose.worldFromBody, spin);
  setParts(body, {{.halfExtents = body.halfExtents, .turned = true, .bodyFromPart = bodyFromPart}});
  return body;
}

}  // namespace careen::test
