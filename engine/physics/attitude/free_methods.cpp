#include "physics/attitude/free_methods.h"

#include <array>
#include <stdexcept>

#include "physics/attitude/free_splitting.h"
#include "physics/attitude/moser_veselov.h"
#include "physics/attitude/runge_kutta4.h"
#include "physics/attitude/taylor8.h"
#include "physics/world/method.h"

namespace careen {

std::span<const FreeMethod> freeMethods() {
  static constexpr std::array<FreeMethod, 4> kFreeMethods = {{
      {Method::kStrang, strangSteps<double>, false, true, true},
      {Method::kRungeKutta4, rungeKutta4Steps<double>, false, false, false},
      {Method::kTaylor8, taylor8Steps<double>, false, false, false},
      {Method::kMoserVeselov10, moserVeselovSteps<double>, true, true, true},
  }};
  return kFreeMethods;
}

const FreeMethod& freeMethod(Method method) {
  for (const FreeMethod& each : freeMethods()) {
    if (each.method == method) {
      return each;
    }
  }
  throw std::logic_error("no method of free bodies");
}

}  // namespace careen
