#pragma once

#include <cstdint>
#include <span>

#include "physics/attitude/free_step.h"
#include "physics/world/method.h"

namespace careen {

/// A method that steps a free body, and what is claimed of it; the claims are tested.
struct FreeMethod {
  Method method;
  void (*steps)(const Vec3& inertia, FreeState<double>& state, const double& dt, std::int64_t count);
  bool keepsEnergy;    // to rounding, whatever the step
  bool keepsMomentum;  // likewise |m| and the momentum in the world
  bool symmetric;      // steps of −dt lead back
};

/// All there are, by order.
std::span<const FreeMethod> freeMethods();
/// The one that `method` is; std::logic_error if it is another kind of method.
const FreeMethod& freeMethod(Method method);

}  // namespace careen
