#include "physics/attitude/runge_kutta4.h"

#include <gtest/gtest.h>

#include "support/free_runs.h"

namespace careen {
namespace {

TEST(RungeKutta4, isOfFourthOrder) {
  const Orders orders = observedOrders(rungeKutta4Steps<Quad>, 64);
  for (std::size_t k = 0; k < orders.attitude.size(); ++k) {
    EXPECT_NEAR(orders.attitude.at(k), 4, 0.15);  // measured 3.999 to 4.000
    EXPECT_NEAR(orders.energy.at(k), 4, 0.15);    // measured 3.91 to 3.98
  }
}

}  // namespace
}  // namespace careen
