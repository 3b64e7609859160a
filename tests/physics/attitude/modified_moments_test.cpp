#include "physics/attitude/modified_moments.h"

#include <gtest/gtest.h>

#include <cmath>

namespace careen {
namespace {

TEST(ModifiedMoments, areTheBodysOwnForAStepOfNoLength) {
  const Vec3 moments(0.5, 2, 4);
  EXPECT_EQ(inverseModifiedMoments(moments, {1, 2, 3}, 0.0), moments.cwiseInverse());
}

// About a body axis the method's equation is I g = ½ h m (1 + g²), g = tan(hω/2): sin hω = h m/Ĩ. The first
// term left out of the sine is (hω)¹¹/11!.
TEST(ModifiedMoments, ofASpinAboutAnAxisAreASine) {
  const Vec3 moments(0.7, 1.1, 1.5);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double angle : {0.1, 0.5, 1.0}) {
      const double h = 0.3;
      Vec3 momentum = Vec3::Zero();
      momentum[axis] = moments[axis] * angle / h;
      const double got = h * momentum[axis] * inverseModifiedMoments(moments, momentum, h)[axis];
      // measured 0.99 of the term at most
      EXPECT_LT(std::fabs(got - std::sin(angle)), std::pow(angle, 11) / 39916800 + 4e-16)
          << axis << ' ' << angle;
    }
  }
}

}  // namespace
}  // namespace careen
