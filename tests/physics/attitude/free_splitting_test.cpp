#include "physics/attitude/free_splitting.h"

#include <gtest/gtest.h>

#include "support/free_runs.h"

namespace careen {
namespace {

TEST(FreeSplitting, strangIsOfSecondOrder) {
  const Orders orders = observedOrders(strangSteps<Quad>, 16);
  for (std::size_t k = 0; k < orders.attitude.size(); ++k) {
    EXPECT_NEAR(orders.attitude.at(k), 2, 0.15);  // measured 2.000 to 2.002
    EXPECT_NEAR(orders.energy.at(k), 2, 0.15);    // measured 2.000 to 2.002
  }
}

// What the run joins is not left out: many steps in one call are as many calls.
TEST(FreeSplitting, stepsInOneCallAreStepsInMany) {
  FreeRun<double> once(tumblingStart());
  FreeRun<double> often(tumblingStart());
  strangSteps(once.moments, once.state, 0.1, 20);
  for (int i = 0; i < 20; ++i) {
    strangSteps(often.moments, often.state, 0.1, 1);
  }
  // measured 1.8e-15
  EXPECT_LT((once.state.worldFromBody.coeffs() - often.state.worldFromBody.coeffs()).norm(), 1e-14);
  EXPECT_LT((once.state.bodyMomentum - often.state.bodyMomentum).norm(), 1e-14 * once.length());
}

}  // namespace
}  // namespace careen
