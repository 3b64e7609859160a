#include "physics/world/given_inertia.h"

#include <cmath>
#include <cstddef>

#include "core/brief.h"
#include "core/error.h"

namespace careen {

std::string whyNoInertia(const Vec3& moments) {
  constexpr double kRounding = 1e-12;  // of the moments
  for (const double moment : moments) {
    if (!(std::isfinite(moment) && moment > 0)) {
      return "moments of inertia that are positive";
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    const double others = moments.sum() - moments[axis];
    if (moments[axis] > others * (1 + kRounding)) {
      return "no moment of inertia above the sum of the two others, " + brief(others) + " kg m²";
    }
  }
  return "";
}

MassProperties massWithInertia(double mass, const Vec3& moments) {
  const std::string why = whyNoInertia(moments);
  if (!(std::isfinite(mass) && mass > 0) || !why.empty()) {
    throw InputError("a body needs a positive, finite mass and " +
                     (why.empty() ? "moments of inertia" : why));
  }
  return {.mass = mass,
          .inverseMass = 1 / mass,
          .inertiaBody = moments,
          .inverseInertiaBody = moments.cwiseInverse()};
}

}  // namespace careen
