#include "physics/motion/listing1.h"

#include "core/math/rotation.h"
#include "physics/world/kinematics.h"

namespace careen {

BodyState listing1Step(const MassProperties& mass, const BodyState& start, const Load& load, double h) {
  const Vec3 omega = angularVelocity(mass, start);
  const Mat3& worldFromBody = start.pose.worldFromBody;

  BodyState end;
  end.pose.position = start.pose.position + h * start.velocity;
  end.velocity = start.velocity + h * centerAcceleration(mass.inverseMass, load.force);
  end.pose.worldFromBody =
      orthonormalizeFromColumn0(worldFromBody + h * orientationRate(omega, worldFromBody));
  end.angularMomentum = start.angularMomentum + h * load.torque;
  return end;
}

}  // namespace careen
