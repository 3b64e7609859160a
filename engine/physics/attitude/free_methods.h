#pragma once

#include <cstdint>
#include <span>

#include "physics/attitude/free_step.h"

namespace careen {

enum class Method : int;  // see world/method.h

/// A method that steps a free body, and its claimed properties, which are tested.
struct FreeMethod {
  Method method;
  void (*steps)(const Vec3& inertia, FreeState<double>& state, const double& dt, std::int64_t count);
  bool keepsEnergy;    // to rounding, for any step
  bool keepsMomentum;  // likewise |m| and the momentum in the world
  bool symmetric;      // time-reversible: steps of −dt lead back
};

/// All methods, by order.
std::span<const FreeMethod> freeMethods();
/// The one for `method`; std::logic_error if it is another kind of method.
const FreeMethod& freeMethod(Method method);

}  // namespace careen
