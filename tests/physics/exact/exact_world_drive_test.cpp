// Dry friction and drives in joints, against closed forms: errors beside what was measured.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>
#include <vector>

#include "support/jointed.h"

namespace careen {
namespace {

using test::bar;
using test::endAt;
using test::frameAlong;
using test::join;
using Kind = Joint::Kind;

constexpr double kGravityOfDrives = 9.81;

// A wheel of 2 kg whose axle is along z.
World flywheel(double spin) {
  World world;
  world.gravity = Vec3::Zero();
  world.bodies = {box("wheel", Vec3(0.3, 0.3, 0.1), 2, Vec3(0, 0, 1), Vec3::Zero(), Vec3(0, 0, spin))};
  join(world, Kind::kHinge, 0, {}, Vec3(0, 0, 1));
  return world;
}

double spinAt(const World& world, const Recorded& run, double time) {
  return angularVelocity(world.bodies[0].mass, run.at(world, 0, time))[2];
}

// [rad] That a turn about an axis is away from another one, of both within half a turn.
double turnedAwayFrom(const Mat3& attitude, double angle, const Vec3& axis) {
  return Eigen::AngleAxisd(Mat3(attitude * Eigen::AngleAxisd(-angle, axis).toRotationMatrix())).angle();
}

// [s] When the last motion of a body begins, which is rest.
double restsFrom(const Recorded& run, std::size_t body) {
  const auto& [start, motion] = run.motions[body].back();
  EXPECT_TRUE(std::holds_alternative<Rest>(motion));
  return start;
}

// ω₀ I/τ = 2.8 s, ω₀² I/2τ = 9.8 rad: 6.2e-15 s late and 3.8e-8 rad off.
TEST(ExactWorldDrive, frictionStopsAFlywheelWhenItHasTakenItsMomentum) {
  World world = flywheel(7);
  world.joints[0].grip = 0.3;
  const Recorded run = runFor(world, 5);
  const double inertia = world.bodies[0].mass.inertiaBody[2];
  EXPECT_NEAR(restsFrom(run, 0), 7 * inertia / 0.3, 1e-12);
  EXPECT_NEAR(spinAt(world, run, 1.4), 3.5, 1e-6);
  EXPECT_LE(turnedAwayFrom(run.last(world, 0, 5).pose.worldFromBody, 49 * inertia / 0.6, Vec3::UnitZ()),
            1e-6);
}

// An arm of 1 m and 1 kg, horizontal: m g l = 4.905 N m.
World armHeldBy(double friction) {
  World world;
  world.gravity = Vec3(0, 0, -kGravityOfDrives);
  world.bodies = {bar("arm", M_PI_2)};
  join(world, Kind::kHinge, 0, {}, Vec3::Zero(), Vec3::UnitY()).grip = friction;
  return world;
}

TEST(ExactWorldDrive, frictionHoldsAnArmThatIsLightEnough) {
  const World holds = armHeldBy(4.906);
  const Recorded held = runFor(holds, 2);
  EXPECT_EQ(restsFrom(held, 0), 0);
  // With less it falls, at first with (m g l − τ)/I about its end.
  const World slips = armHeldBy(4.904);
  const Recorded fallen = runFor(slips, 2);
  constexpr double kSoon = 1e-3;
  const double inertia = slips.bodies[0].mass.inertiaBody[1] + 0.25;
  const double fallsBy = 0.5 * (4.905 - 4.904) / inertia * kSoon * kSoon;  // [rad]
  const double now = fallen.at(slips, 0, kSoon).pose.position[2];
  EXPECT_NEAR(now, -0.5 * fallsBy, 1e-5 * fallsBy);
}

// 1 kg on a slope of 3 : 4, thrown up it with 3 m/s, friction 7 N: up with −(g sin α + 7) m/s², and as 7 N is
// more than its weight along the slope, there it stays; 4 N let it slide back: 8e-15 m off.
TEST(ExactWorldDrive, frictionStopsASliderOnASlope) {
  const Vec3 up(0.8, 0, 0.6);
  for (const double friction : {7.0, 4.0}) {
    World world;
    world.gravity = Vec3(0, 0, -kGravityOfDrives);
    world.bodies = {box("sledge", Vec3(0.2, 0.2, 0.1), 1, Vec3(0, 0, 1), 3 * up)};
    join(world, Kind::kSlider, 0, {}, Vec3(0, 0, 1), up).grip = friction;
    const Recorded run = runFor(world, 2);
    const double weight = 0.6 * kGravityOfDrives;
    const double upFor = 3 / (weight + friction);  // [s]
    const double top = 1.5 * upFor;                // [m]
    if (friction > weight) {
      EXPECT_NEAR(restsFrom(run, 0), upFor, 1e-12);
      EXPECT_LE((run.last(world, 0, 2).pose.position - (Vec3(0, 0, 1) + top * up)).norm(), 1e-12);
    } else {
      const double down = 0.5 * (weight - friction) * (2 - upFor) * (2 - upFor);
      EXPECT_LE((run.last(world, 0, 2).pose.position - (Vec3(0, 0, 1) + (top - down) * up)).norm(), 1e-10);
    }
  }
}

// I = 0.12 kg m², τ = 0.3 N m: 4 rad/s after 1.6 s, and from then on; 9e-16 rad/s and 8e-8 rad off.
TEST(ExactWorldDrive, aDriveBringsAFlywheelToItsSpeedAndKeepsIt) {
  World world = flywheel(0);
  world.joints[0].grip = 0.3;
  world.joints[0].keptRate = 4;
  const Recorded run = runFor(world, 5);
  EXPECT_NEAR(spinAt(world, run, 0.8), 2, 1e-6);
  const auto& segments = run.motions[0];
  EXPECT_TRUE(std::any_of(segments.begin(), segments.end(),
                          [](const auto& segment) { return std::fabs(segment.first - 1.6) <= 1e-12; }));
  for (const auto& [start, motion] : segments) {
    const double spin = spinAt(world, run, start);
    EXPECT_NEAR(spin, std::min(4.0, 2.5 * start), 1e-12) << start;
  }
  const double turned = 0.5 * 4 * 1.6 + 4 * 3.4;
  EXPECT_LE(turnedAwayFrom(run.last(world, 0, 5).pose.worldFromBody, turned, Vec3::UnitZ()), 1e-6);
}

// A lift of 2 kg at 0.5 m/s: with 30 N it holds its speed, with 15 N its weight of 19.62 N wins.
TEST(ExactWorldDrive, aDriveHoldsItsSpeedUnderLessLoadThanItsLargest) {
  for (const double largest : {30.0, 15.0}) {
    World world;
    world.gravity = Vec3(0, 0, -kGravityOfDrives);
    world.bodies = {box("lift", Vec3(0.2, 0.2, 0.1), 2, Vec3(0, 0, 1))};
    Joint& rail = join(world, Kind::kSlider, 0, {}, Vec3(0, 0, 1));
    rail.grip = largest;
    rail.keptRate = 0.5;
    const Recorded run = runFor(world, 1);
    const double acceleration = largest / 2 - kGravityOfDrives;
    const double gathers = 0.5 / acceleration;  // [s] if it is positive
    const double height = acceleration > 0 ? 0.25 * gathers + 0.5 * (1 - gathers) : 0.5 * acceleration;
    const BodyState last = run.last(world, 0, 1);
    EXPECT_NEAR(last.pose.position[2], 1 + height, 1e-12);
    EXPECT_NEAR(last.velocity[2], acceleration > 0 ? 0.5 : acceleration, 1e-12);
  }
}

// θ″ = −k² sin θ ∓ τ/I in extended precision, from turn to turn, each where the rate is zero: the mechanism
// rests at the first of them at which τ is enough.
struct Swung {
  long double angle = 0;
  long double time = 0;
  int turns = 0;
};
Swung swungOut(long double angle, long double squaredFrequency, long double friction) {
  constexpr long double kStep = 1e-5L;
  Swung at{.angle = angle};
  while (squaredFrequency * std::fabs(std::sin(at.angle)) > friction) {
    const long double drag = at.angle > 0 ? friction : -friction;  // it goes towards the middle
    const auto pull = [&](long double q) { return -squaredFrequency * std::sin(q) + drag; };
    const auto step = [&](std::array<long double, 2> q, long double h) {
      const std::array<long double, 2> k1{q[1], pull(q[0])};
      const std::array<long double, 2> k2{q[1] + h / 2 * k1[1], pull(q[0] + h / 2 * k1[0])};
      const std::array<long double, 2> k3{q[1] + h / 2 * k2[1], pull(q[0] + h / 2 * k2[0])};
      const std::array<long double, 2> k4{q[1] + h * k3[1], pull(q[0] + h * k3[0])};
      return std::array<long double, 2>{q[0] + h / 6 * (k1[0] + 2 * k2[0] + 2 * k3[0] + k4[0]),
                                        q[1] + h / 6 * (k1[1] + 2 * k2[1] + 2 * k3[1] + k4[1])};
    };
    std::array<long double, 2> q = step({at.angle, 0}, kStep);
    long double time = kStep;
    for (std::array<long double, 2> next = step(q, kStep); next[1] * q[1] > 0; next = step(q, kStep)) {
      q = next;
      time += kStep;
    }
    for (int k = 0; k < 4; ++k) {  // Newton, for the rest of the last step
      const long double rest = -q[1] / pull(q[0]);
      q = step(q, rest);
      time += rest;
    }
    at = {.angle = q[0], .time = at.time + time, .turns = at.turns + 1};
  }
  return at;
}

// From 1 rad it swings six times, and rests after 5.03 s: 5.0e-7 s and 4.9e-7 rad off.
TEST(ExactWorldDrive, frictionTakesAPendulumToRestSwingBySwing) {
  World world;
  world.gravity = Vec3(0, 0, -kGravityOfDrives);
  world.bodies = {bar("bar", 1)};
  join(world, Kind::kHinge, 0, {}, Vec3::Zero(), Vec3::UnitY()).grip = 0.4;
  const Recorded run = runFor(world, 10);
  const long double inertia = world.bodies[0].mass.inertiaBody[1] + 0.25L;
  const Swung due = swungOut(1, kGravityOfDrives * 0.5L / inertia, 0.4L / inertia);
  EXPECT_EQ(due.turns, 6);
  EXPECT_NEAR(restsFrom(run, 0), static_cast<double>(due.time), 2e-6);
  const Mat3 attitude = run.last(world, 0, 10).pose.worldFromBody;
  EXPECT_NEAR(std::atan2(attitude(0, 2), attitude(2, 2)), static_cast<double>(due.angle), 2e-6);
}

// A spring of 2 N m/rad and friction of 0.25 N m: each half swing loses 2 τ/k = 0.25 rad, from 1 rad to
// −0.75, 0.5, −0.25 and 0, where it rests: 1.2e-7 s and 4.6e-7 rad off.
TEST(ExactWorldDrive, frictionTakesTheSameFromEachSwingOfASpring) {
  World world = flywheel(0);
  Joint& axle = world.joints[0];
  axle.stiffness = 2;
  axle.rest = 1;
  axle.grip = 0.25;
  const Recorded run = runFor(world, 5);
  const double halfSwing = M_PI / std::sqrt(2 / world.bodies[0].mass.inertiaBody[2]);
  EXPECT_NEAR(restsFrom(run, 0), 4 * halfSwing, 1e-6);
  for (const auto& [swings, angle] :
       {std::pair(1, 1.75), std::pair(2, 0.5), std::pair(3, 1.25), std::pair(4, 1.0)}) {
    const Mat3 attitude = run.at(world, 0, swings * halfSwing).pose.worldFromBody;
    EXPECT_LE(turnedAwayFrom(attitude, angle, Vec3::UnitZ()), 2e-6) << swings;
  }
}

// 1 kg hangs on a rail by 10 N, and on it 2 kg by 15 N: both fall as one, with g − 10/3 m/s², by 6.67 N
// between them.
TEST(ExactWorldDrive, frictionsInSeriesShareAsTheyMust) {
  World world;
  world.gravity = Vec3(0, 0, -kGravityOfDrives);
  world.bodies = {box("upper", Vec3::Constant(0.1), 1, Vec3(0, 0, 1)),
                  box("lower", Vec3::Constant(0.1), 2, Vec3(0, 0, 0.5))};
  join(world, Kind::kSlider, 0, {}, Vec3(0, 0, 1)).grip = 10;
  join(world, Kind::kSlider, 1, 0, Vec3(0, 0, 0.5)).grip = 15;
  const Recorded run = runFor(world, 1);
  const double falls = 0.5 * (kGravityOfDrives - 10. / 3);
  EXPECT_NEAR(run.last(world, 0, 1).pose.position[2], 1 - falls, 1e-10);
  EXPECT_NEAR(run.last(world, 1, 1).pose.position[2], 0.5 - falls, 1e-10);
}

// It meets its limit with √(2 τ θ/I) = √7.5 rad/s, of which e = 0 leaves nothing, and stays there: 6.4e-9 s
// off.
TEST(ExactWorldDrive, aDriveIntoALimitJustStops) {
  World world = flywheel(0);
  world.joints[0].grip = 0.3;
  world.joints[0].keptRate = 4;
  world.joints[0].lowest = -1;
  world.joints[0].highest = 1.5;
  const Recorded run = runFor(world, 5);
  EXPECT_NEAR(restsFrom(run, 0), std::sqrt(1.2), 1e-6);
  EXPECT_LE(turnedAwayFrom(run.last(world, 0, 5).pose.worldFromBody, 1.5, Vec3::UnitZ()), 1e-6);
  ASSERT_EQ(run.passed.size(), 1U);
  const double inertia = world.bodies[0].mass.inertiaBody[2];
  EXPECT_LE((run.passed[0].angular - Vec3(0, 0, -inertia * std::sqrt(7.5))).norm(), 1e-6);
}

// Two links: what the friction of their hinge takes from one it gives the other, until they turn as one,
// about their common centre of mass, with all the angular momentum: 2.5e-10 kg m²/s off.
TEST(ExactWorldDrive, frictionBetweenLinksKeepsTheirMomenta) {
  World world;
  world.gravity = Vec3::Zero();
  world.bodies = {box("left", Vec3(0.5, 0.1, 0.1), 1, Vec3(-0.5, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, 2)),
                  box("right", Vec3(0.5, 0.1, 0.1), 3, Vec3(0.5, 0, 0), Vec3(0, -0.5, 0), Vec3(0, 0, -1))};
  join(world, Kind::kHinge, 0, 1, Vec3::Zero()).grip = 0.2;
  const Recorded run = runFor(world, 10);
  const auto momentum = [&](double time) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < 2; ++i) {
      const BodyState state = run.at(world, i, time);
      sum += state.angularMomentum + world.bodies[i].mass.mass * state.pose.position.cross(state.velocity);
    }
    return sum;
  };
  EXPECT_LE((momentum(10) - momentum(0)).norm(), 1e-9);  // of 9 kg m²/s that it has far from the origin
  const auto spinOf = [&](std::size_t i) {
    return angularVelocity(world.bodies[i].mass, run.at(world, i, 10))[2];
  };
  EXPECT_NEAR(spinOf(0), spinOf(1), 1e-9);
}

// It lets go at 1 s: from then on nothing brakes the wheel.
TEST(ExactWorldDrive, frictionEndsWithItsJoint) {
  World world = flywheel(7);
  world.joints[0].grip = 0.3;
  world.joints[0].until = 1;
  const Recorded run = runFor(world, 5);
  for (const auto& [start, motion] : run.motions[0]) {
    EXPECT_NEAR(spinAt(world, run, start),
                7 - std::min(start, 1.0) * 0.3 / world.bodies[0].mass.inertiaBody[2], 1e-12);
  }
}

// At the bound to rounding it neither jitters nor falls.
TEST(ExactWorldDrive, frictionThatIsJustEnoughHolds) {
  World world;
  world.gravity = Vec3(0, 0, -8);
  world.bodies = {box("weight", Vec3(0.25, 0.25, 0.25), 2, Vec3(0, 0, 1))};
  join(world, Kind::kSlider, 0, {}, Vec3(0, 0, 1)).grip = 16;
  const Recorded run = runFor(world, 2);
  EXPECT_EQ(restsFrom(run, 0), 0);
}

}  // namespace
}  // namespace careen
