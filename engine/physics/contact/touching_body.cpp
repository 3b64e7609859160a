#include "physics/contact/touching_body.h"

#include <algorithm>

namespace careen {

TouchingBody drivenAt(const TouchingBody& body, double time) {
  TouchingBody moved = body;
  moved.time = time;
  const Kinematics now = moved.kinematics();
  moved.position = now.pose.position;
  moved.worldFromBody = Quat(now.pose.worldFromBody);
  moved.velocity = now.velocity;
  moved.angularVelocityBody = now.pose.worldFromBody.transpose() * now.angularVelocity;
  return moved;
}

double drivenAcceleration(std::span<const TouchingBody> bodies) {
  double most = 0;
  for (const TouchingBody& body : bodies) {
    if (body.isDriven()) {
      const MotionRates rates = boundsOf(body.drivenBy->motion);
      const double turning = rates.angularSpeed * rates.angularSpeed + rates.angularAcceleration;
      most = std::max(most, rates.acceleration + turning * radiusOf(*body.body));
    }
  }
  return most;
}

}  // namespace careen
