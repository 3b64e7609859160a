// A top on a ball joint against its own equation.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "support/jointed.h"

namespace careen {
namespace {

// Where the axis of a symmetric top is after a time [s] that begins leaning by θ [rad] without precession:
// from its two momenta, θ'' = (φ'² cos θ − φ' L₃/I₁ + m g l/I₁) sin θ with φ' = (L_z − L₃ cos θ)/(I₁ sin² θ),
// by Runge's method of order 4 in extended precision.
Vec3 topAfter(double time, long double lean, long double spinMomentum, long double inertia,
              long double torque) {
  constexpr int kSteps = 400000;
  const long double h = static_cast<long double>(time) / kSteps;
  const long double vertical = spinMomentum * std::cos(lean);
  using State = std::array<long double, 3>;  // θ, θ', φ
  const auto rate = [&](const State& at) -> State {
    const long double sine = std::sin(at[0]);
    const long double cosine = std::cos(at[0]);
    const long double precession = (vertical - spinMomentum * cosine) / (inertia * sine * sine);
    return {
        at[1],
        (precession * precession * cosine - precession * spinMomentum / inertia + torque / inertia) * sine,
        precession};
  };
  const auto plus = [](const State& at, long double part, const State& by) -> State {
    return {at[0] + part * by[0], at[1] + part * by[1], at[2] + part * by[2]};
  };
  State at{lean, 0, 0};
  for (int k = 0; k < kSteps; ++k) {
    const State first = rate(at);
    const State second = rate(plus(at, h / 2, first));
    const State third = rate(plus(at, h / 2, second));
    const State fourth = rate(plus(at, h, third));
    for (std::size_t d = 0; d < 3; ++d) {
      at[d] += h / 6 * (first[d] + 2 * second[d] + 2 * third[d] + fourth[d]);
    }
  }
  const long double across = std::sin(at[0]);
  return {static_cast<double>(across * std::sin(at[2])), static_cast<double>(-across * std::cos(at[2])),
          static_cast<double>(std::cos(at[0]))};
}

constexpr double kGravityOfTops = 9.81;

World swingingTops() {
  World world;
  world.gravity = Vec3(0, 0, -kGravityOfTops);
  return world;
}

// 60 rad/s on a ball joint for 10 s: 5.0 and 0.27 tolerances off.
TEST(ExactWorldJoints, aTopPrecesses) {
  struct Top {
    Vec3 halfExtents;
    double lean;
  };
  for (const Top& each : {Top{Vec3(0.15, 0.15, 0.03), 0.6}, Top{Vec3(0.2, 0.2, 0.02), 0.3}}) {
    World world = swingingTops();
    world.bodies = {box("top", each.halfExtents, 1, Vec3::Zero())};
    Body& top = world.bodies[0];
    const Mat3 turned = Eigen::AngleAxisd(each.lean, Vec3::UnitX()).toRotationMatrix();
    top.initial.pose = {.position = turned * Vec3(0, 0, 0.2), .worldFromBody = turned};
    const double momentum = 60 * top.mass.inertiaBody[2];
    top.initial.angularMomentum = momentum * turned.col(2);
    test::join(world, Joint::Kind::kBall, 0, {}, Vec3::Zero());
    const Recorded run = runFor(world, 10);
    const Vec3 axis =
        topAfter(10, each.lean, momentum, top.mass.inertiaBody[0] + 0.2L * 0.2L, kGravityOfTops * 0.2L);
    EXPECT_LE((run.last(world, 0, 10).pose.position - 0.2 * axis).norm(), 1e-5);
  }
}

}  // namespace
}  // namespace careen
