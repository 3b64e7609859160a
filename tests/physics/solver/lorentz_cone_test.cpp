#include "physics/solver/lorentz_cone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

namespace careen::lorentz {
namespace {

constexpr Vector kR{3, 1, -2};
constexpr Vector kW{2, -1, 0.5};

void expectNear(const Vector& x, const Vector& y) {
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(x[k], y[k], 1e-14);
  }
}

// By hand: 9 − 5 = 4; (6 − 1 − 1, −3 + 2, 1.5 − 4).
TEST(LorentzCone, products) {
  EXPECT_NEAR(determinant(kR), 4, 1e-14);
  expectNear(product(kR, kW), {4, -1, -2.5});
  expectNear(product(kR, quotient(kR, kW)), kW);
}

TEST(LorentzCone, scalingMapsWToR) {
  Vector point{};
  const double size2 = scalingPoint(kR, kW, point);
  EXPECT_NEAR(determinant(point), 1, 1e-14);
  expectNear(scaledTwice(point, size2, kW), kR);
  const double size = std::sqrt(size2);
  const Vector v = scaledOnce(point, size, kW);
  expectNear(scaledOnce(point, size, v), kR);  // W v = W² w
}

TEST(LorentzCone, reachEndsAtTheSurface) {
  for (const Vector& d :
       {Vector{-1, 0, 0}, Vector{-1, 0.5, 2}, Vector{1, 3, 0}, Vector{0, 0, -1}, Vector{-3, -1, 2}}) {
    const double most = reach(kR, d);
    const Vector at{kR[0] + most * d[0], kR[1] + most * d[1], kR[2] + most * d[2]};
    EXPECT_GT(most, 0);
    EXPECT_NEAR(determinant(at), 0, 1e-12);
    EXPECT_GE(at[0], -1e-15);
  }
  EXPECT_NEAR(reach({1.7, 0.3, 0.1}, {-1.7, -0.3, -0.1}), 1, 1e-7);  // to the apex
  EXPECT_TRUE(std::isinf(reach(kR, {1, 0.5, 0.5})));
  EXPECT_TRUE(std::isinf(reach(kR, {0, 0, 0})));
}

}  // namespace
}  // namespace careen::lorentz
