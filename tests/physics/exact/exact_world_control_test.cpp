// Springs and motors of joints against extended precision and closed forms: errors beside what was measured.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "support/jointed.h"

namespace careen {
namespace {

using test::bar;
using test::join;
using Kind = Joint::Kind;
using Real = long double;

constexpr double kGravityOfMotors = 9.81;

// One step of Runge's method of order 4 of y″ = f(y, y′).
template <std::size_t N, class Force>
void step(std::array<Real, N>& place, std::array<Real, N>& speed, Real h, const Force& force) {
  using Numbers = std::array<Real, N>;
  const auto moved = [](const Numbers& from, Real by, const Numbers& along) {
    Numbers sum = from;
    for (std::size_t k = 0; k < N; ++k) {
      sum[k] += by * along[k];
    }
    return sum;
  };
  const Numbers rate1 = force(place, speed);
  const Numbers speed2 = moved(speed, h / 2, rate1);
  const Numbers rate2 = force(moved(place, h / 2, speed), speed2);
  const Numbers speed3 = moved(speed, h / 2, rate2);
  const Numbers rate3 = force(moved(place, h / 2, speed2), speed3);
  const Numbers speed4 = moved(speed, h, rate3);
  const Numbers rate4 = force(moved(place, h, speed3), speed4);
  for (std::size_t k = 0; k < N; ++k) {
    place[k] += h / 6 * (speed[k] + 2 * speed2[k] + 2 * speed3[k] + speed4[k]);
    speed[k] += h / 6 * (rate1[k] + 2 * rate2[k] + 2 * rate3[k] + rate4[k]);
  }
}

// 1.5e-7 m off after 10 s.
TEST(ExactWorldControl, aSprungHingeSwingsAsItsEquationSays) {
  World world;
  world.gravity = Vec3(0, 0, -kGravityOfMotors);
  world.bodies = {bar("bar", 0.5)};
  join(world, Kind::kHinge, 0, {}, Vec3::Zero(), Vec3::UnitY()).stiffness = 3;
  const Recorded run = runFor(world, 10);
  const Real inertia = world.bodies[0].mass.inertiaBody[1] + 0.25L;
  std::array<Real, 1> angle{0.5L};
  std::array<Real, 1> rate{0};
  for (int k = 0; k < 100000; ++k) {
    step(angle, rate, 1e-4L, [&](const std::array<Real, 1>& q, const std::array<Real, 1>&) {
      return std::array<Real, 1>{(-9.81L / 2 * std::sin(q[0]) - 3 * (q[0] - 0.5L)) / inertia};
    });
  }
  const double at = static_cast<double>(angle[0]);
  const Vec3 truth(-0.5 * std::sin(at), 0, -0.5 * std::cos(at));
  EXPECT_LE((run.last(world, 0, 10).pose.position - truth).norm(), 5e-7);
}

// A slide with a spring, a damper and a motor that looks 50 times a second and aims elsewhere after 4 s:
// 4.9e-14 m.
TEST(ExactWorldControl, aSlideFollowsItsMotor) {
  World world;
  world.bodies = {box("slide", Vec3::Constant(0.1), 2, Vec3::Zero())};
  Joint& rail = join(world, Kind::kSlider, 0, {}, Vec3::Zero(), Vec3::UnitX());
  rail.stiffness = 5;
  rail.damping = 0.7;
  Motor motor{.joint = 0, .stiffness = 40, .damping = 6};
  motor.target.path = {{0.01, 1}, {4, 1}, {4.01, -0.5}};
  world.control = Control{.period = 0.02, .motors = {motor}};
  const Recorded run = runFor(world, 10);
  std::array<Real, 1> place{0};
  std::array<Real, 1> speed{0};
  for (int sample = 0; sample < 500; ++sample) {
    const MotorTarget::Aim aim = motor.target.at(sample * 0.02);
    const Real effort = 40 * (aim.coordinate - place[0]) + 6 * (aim.rate - speed[0]);
    for (int k = 0; k < 50; ++k) {
      step(place, speed, 0.02L / 50, [&](const std::array<Real, 1>& q, const std::array<Real, 1>& v) {
        return std::array<Real, 1>{(effort - 5 * q[0] - 0.7L * v[0]) / 2};
      });
    }
  }
  EXPECT_NEAR(run.last(world, 0, 10).pose.position.x(), static_cast<double>(place[0]), 1e-12);
}

// From 0.35 rad, by four gains, 50 times a second: 1.6e-8 m off after 10 s, when the pole stands.
TEST(ExactWorldControl, aCartKeepsItsPoleUp) {
  World world;
  world.gravity = Vec3(0, 0, -kGravityOfMotors);
  const double lean = 0.35;
  world.bodies = {box("cart", Vec3(0.2, 0.1, 0.1), 1, Vec3::Zero()), bar("pole", lean)};
  Body& pole = world.bodies[1];
  pole.mass = solidBox(pole.halfExtents, 0.3);
  pole.initial.pose.position = -pole.initial.pose.position;  // above
  join(world, Kind::kSlider, 0, {}, Vec3::Zero(), Vec3::UnitX());
  join(world, Kind::kHinge, 1, 0, Vec3::Zero(), Vec3::UnitY());
  const std::array<double, 4> gains{2.8295, 4.2276, 41.3668, 10.1851};
  world.control = Control{.period = 0.02, .motors = {}};
  world.control->callback = [&](double, std::span<const BodyState>, std::span<const JointSample> joints,
                                std::span<double> efforts) {
    efforts[0] = gains[0] * joints[0].coordinate + gains[1] * joints[0].rate +
                 gains[2] * (lean + joints[1].coordinate) + gains[3] * joints[1].rate;
  };
  const Recorded run = runFor(world, 10);
  const Real inertia = pole.mass.inertiaBody[1];
  std::array<Real, 2> q{0, lean};
  std::array<Real, 2> v{0, 0};
  for (int sample = 0; sample < 500; ++sample) {
    const Real effort = gains[0] * q[0] + gains[1] * v[0] + gains[2] * q[1] + gains[3] * v[1];
    for (int k = 0; k < 50; ++k) {
      step(q, v, 0.02L / 50, [&](const std::array<Real, 2>& at, const std::array<Real, 2>& rate) {
        const Real across = 0.15L * std::cos(at[1]);
        const Real turning = inertia + 0.075L;
        const Real push = effort + 0.15L * rate[1] * rate[1] * std::sin(at[1]);
        const Real fall = 0.15L * 9.81L * std::sin(at[1]);
        const Real whole = 1.3L * turning - across * across;
        return std::array<Real, 2>{(turning * push - across * fall) / whole,
                                   (1.3L * fall - across * push) / whole};
      });
    }
  }
  EXPECT_NEAR(run.last(world, 0, 10).pose.position.x(), static_cast<double>(q[0]), 5e-8);
  EXPECT_LT(std::fabs(static_cast<double>(q[1])), 2e-5);  // 5.3e-6
}

// A box turns itself over by a flap that its motor swings against the floor, whatever the tolerance.
TEST(ExactWorldControl, aBoxTurnsItselfOver) {
  World world;
  world.gravity = Vec3(0, 0, -kGravityOfMotors);
  world.walls = {wall("floor", Vec3::UnitZ(), 0, 0)};
  world.walls[0].material.friction = 0.7;
  world.bodies = {
      box("body", Vec3(0.25, 0.2, 0.08), 6, Vec3(0, 0, 0.08), Vec3::Zero(), Vec3::Zero(), 0),
      box("flap", Vec3(0.35, 0.18, 0.02), 1.5, Vec3(-0.1, 0, 0.2), Vec3::Zero(), Vec3::Zero(), 0)};
  for (Body& body : world.bodies) {
    body.material.friction = 0.7;
  }
  join(world, Kind::kHinge, 1, 0, Vec3(0.25, 0, 0.2), Vec3::UnitY());
  Motor motor{.joint = 0, .largest = 300, .stiffness = 800, .damping = 20};
  motor.target.path = {{0, 0}, {0.3, 0}, {0.3 + 5.2 / 14, 5.2}};
  world.control = Control{.period = 0.005, .motors = {motor}};
  const Recorded run = runFor(world, 2);
  EXPECT_NEAR(run.at(world, 0, 1.25).pose.worldFromBody(2, 2), -0.995, 5e-4);  // 2.1e-4
  EXPECT_NEAR(run.last(world, 0, 2).pose.position.x(), 0.119, 2e-4);           // 4.3e-5
  EXPECT_LE(test::largestGapIn(world, run, 2), 2e-7);                          // 4.3e-8
}

}  // namespace
}  // namespace careen
