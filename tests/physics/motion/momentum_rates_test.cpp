#include "physics/motion/momentum_rates.h"

#include <gtest/gtest.h>

#include <cmath>

namespace careen {
namespace {

// Of any step: the derivatives of M v and L, by differences of fourth order.
TEST(MomentumRates, areTheDerivativesOfMomenta) {
  MassProperties mass = solidBox(Vec3(0.1, 0.3, 0.2), 3);
  ContactStep step{.duration = 0.25};
  for (std::size_t k = 0; k < 6; ++k) {
    const auto c = static_cast<double>(k);
    step.position.at(k) = Vec3(1 - 0.3 * c, std::sin(c), 0.2 * std::cos(2 * c));
    step.worldFromBody.at(k) =
        k == 0 ? Vec4(0.3, -0.2, 0.5, 0.8) : Vec4(0.1 * std::sin(3 * c), -0.2 / c, 0.1, 0.05 * c);
  }
  constexpr double kStep = 1e-3;
  for (const double elapsed : {0.01, 0.1, 0.2}) {
    const auto momentum = [&](double steps) {
      const BodyState state = stateAt(step, mass, elapsed + steps * kStep);
      return std::pair<Vec3, Vec3>(mass.mass * state.velocity, state.angularMomentum);
    };
    const auto derivative = [&](auto part) {
      return Vec3((8 * (part(momentum(1)) - part(momentum(-1))) - (part(momentum(2)) - part(momentum(-2)))) /
                  (12 * kStep));
    };
    const MomentumRates rates = momentumRatesAt(step, mass, elapsed);
    const Vec3 linear = derivative([](const auto& both) { return both.first; });
    const Vec3 angular = derivative([](const auto& both) { return both.second; });
    EXPECT_LT((rates.linear - linear).norm(), 1e-5 * linear.norm());     // measured: 5e-7
    EXPECT_LT((rates.angular - angular).norm(), 1e-5 * angular.norm());  // measured: 6e-7
  }
}

}  // namespace
}  // namespace careen
