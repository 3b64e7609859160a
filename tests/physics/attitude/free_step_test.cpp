#include "physics/attitude/free_step.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/quad.h"
#include "support/tumbling_box.h"

namespace careen {
namespace {

TEST(FreeStep, bringsAQuaternionToUnitLengthWithoutTurningIt) {
  test::Dice dice(5);
  for (int k = 0; k < 1000; ++k) {
    const Quat q(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1));
    Quat scaled = q;
    scaled.coeffs() *= std::ldexp(1, k % 400 - 200);
    const Quat got = unit<double>(scaled);
    EXPECT_NEAR(got.squaredNorm(), 1, 1e-15);
    EXPECT_LT((got.coeffs() - q.coeffs() / q.norm()).norm(), 4e-16);
  }
}

TEST(FreeStep, doesSoToTheDigitsOfItsType) {
  const Quaternion<Quad> got = unit<Quad>(Quaternion<Quad>(1, 2, -3, 4));
  EXPECT_LT(abs(got.squaredNorm() - 1), Quad(1e-33));
  EXPECT_LT(abs(got.y() * sqrt(Quad(30)) + 3), Quad(1e-32));
}

// A third of a turn about (1, 1, 1) leads from the body's x to the world's y.
TEST(FreeStep, momentumInTheWorldIsTheBodysTurned) {
  const FreeState<double> state{Quat(0.5, 0.5, 0.5, 0.5), Vec3(2, 3, 5)};
  EXPECT_EQ(state.angularMomentumWorld(), Vec3(5, 2, 3));
}

}  // namespace
}  // namespace careen
