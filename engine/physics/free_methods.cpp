#include "physics/free_methods.h"

#include <array>

#include "physics/free_splitting.h"
#include "physics/moser_veselov.h"
#include "physics/runge_kutta4.h"
#include "physics/taylor8.h"

namespace careen {

std::span<const FreeMethod> freeMethods() {
  static constexpr std::array<FreeMethod, 5> kMethods = {{
      {"strang", strangSteps<double>, 2, false, true, true},
      {"runge-kutta-4", rungeKutta4Steps<double>, 4, false, false, false},
      {"splitting-6", splitting6Steps<double>, 6, false, true, true},
      {"taylor-8", taylor8Steps<double>, 8, false, false, false},
      {"moser-veselov-10", moserVeselovSteps<double>, 10, true, true, true},
  }};
  return kMethods;
}

}  // namespace careen
