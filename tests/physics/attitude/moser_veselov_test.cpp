#include "physics/attitude/moser_veselov.h"

#include <gtest/gtest.h>

#include "support/free_runs.h"

namespace careen {
namespace {

TEST(MoserVeselov, isOfTenthOrder) {
  const Orders orders = observedOrders(moserVeselovSteps<Quad>, 16);
  for (const double order : orders.attitude) {
    EXPECT_NEAR(order, 10, 0.15);  // measured 10.001 to 10.014
  }
}

TEST(MoserVeselov, keepsEnergyAndMomentumWithLongStepsInQuadruplePrecision) {
  const FreeRun<Quad> before(tumblingStart());
  FreeRun<Quad> run = before;
  moserVeselovSteps<Quad>(run.moments, run.state, Quad(0.25), 400);  // the attitude is off by 1e-5
  const FreeChange change(before, run);
  EXPECT_LT(std::fabs(change.energy), 1e-32);
  EXPECT_LT(std::fabs(change.length), 1e-32);
  EXPECT_LT(change.world, 1e-31);
}

TEST(MoserVeselov, saysWhenAStepIsTooLongAndLeavesTheStateAlone) {
  FreeRun<double> run(tumblingStart({0, 0, 2}));
  moserVeselovSteps(run.moments, run.state, 0.7, 1);
  EXPECT_NEAR(2 * std::atan2(run.state.worldFromBody.z(), run.state.worldFromBody.w()), 1.4, 1e-4);
  const FreeRun<double> before = run;
  EXPECT_THROW(moserVeselovSteps(run.moments, run.state, 0.8, 1), NumericalError);
  EXPECT_EQ(run.state.worldFromBody.coeffs(), before.state.worldFromBody.coeffs());
  EXPECT_EQ(run.state.bodyMomentum, before.state.bodyMomentum);
}

}  // namespace
}  // namespace careen
