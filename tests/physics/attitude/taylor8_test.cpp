#include "physics/attitude/taylor8.h"

#include <gtest/gtest.h>

#include "support/free_runs.h"

namespace careen {
namespace {

TEST(Taylor8, isOfEighthOrder) {
  const Orders orders = observedOrders(taylor8Steps<Quad>, 16);
  for (std::size_t k = 0; k < orders.attitude.size(); ++k) {
    EXPECT_NEAR(orders.attitude.at(k), 8, 0.15);  // measured 8.001 to 8.002
    EXPECT_NEAR(orders.energy.at(k), 8, 0.15);    // measured 8.01 to 8.03
  }
}

}  // namespace
}  // namespace careen
