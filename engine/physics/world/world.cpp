#include "physics/world/world.h"

#include <algorithm>
#include <limits>

namespace careen {

const Wall& nowhere() {
  static const Wall none{.name = "nowhere",
                         .normal = Vec3::UnitZ(),
                         .offset = -std::numeric_limits<double>::infinity(),
                         .material = {}};
  return none;
}

bool isJointed(const World& world, int body) {
  return std::any_of(world.joints.begin(), world.joints.end(),
                     [&](const Joint& joint) { return joint.from.body == body || joint.to.body == body; });
}

bool mayStillChange(const World& world, const Joint& joint) {
  const auto isOfJoint = [&](const Motor& motor) {
    return &world.joints[static_cast<std::size_t>(motor.joint)] == &joint;
  };
  return joint.until < Joint::kFree || joint.keptRate != 0 ||
         (world.control &&
          ((world.control->callback && joint.hasCoordinate()) ||
           std::any_of(world.control->motors.begin(), world.control->motors.end(), isOfJoint)));
}

}  // namespace careen
