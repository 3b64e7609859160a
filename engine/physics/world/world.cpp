#include "physics/world/world.h"

#include <limits>

namespace careen {

const Wall& nowhere() {
  static const Wall none{.name = "nowhere",
                         .normal = Vec3::UnitZ(),
                         .offset = -std::numeric_limits<double>::infinity(),
                         .material = {}};
  return none;
}

}  // namespace careen
