#include "physics/compared/loop1997.h"

#include <cmath>
#include <complex>
#include <stop_token>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/math/rotation.h"
#include "physics/compared/collision1997.h"
#include "physics/simulate.h"
#include "physics/world/method.h"
#include "support/article_equations.h"
#include "support/physics_worlds.h"
#include "support/without_traps.h"

namespace careen {
namespace {

Memory run(const World& world, double duration, double dt) {
  Memory memory;
  simulate(world, {.method = Method::kListing1, .duration = duration, .dt = dt}, memory);
  return memory;
}

std::string failureOf(const World& world, double duration, double dt) {
  try {
    run(world, duration, dt);
  } catch (const NumericalError& error) {
    return error.what();
  }
  return "(no NumericalError)";
}

std::vector<double> timesOf(const Memory& memory, int body = 0) {
  std::vector<double> times;
  for (const Memory::Move& move : memory.moved) {
    if (move.body == body) {
      times.push_back(move.time);
    }
  }
  return times;
}

World drifting() { return sampleRoom(makeBox({.velocity = {0.25, 0, 0}})); }

/// A cube over the floor, its lowest corner straight under its centre: nothing turns when it strikes.
Body onItsCorner(double height, double restitution) {
  const Mat3 upright = Quat::FromTwoVectors(Vec3(1, 1, 1), Vec3::UnitZ()).toRotationMatrix();
  return makeBox({.position = {0, 0, height + 0.2 * std::sqrt(3.0)},
                  .worldFromBody = upright,
                  .restitution = restitution});
}

TEST(Loop1997, stepsAtMultiplesOfDtExactly) {
  constexpr double kDt = 1.0 / 240;
  const std::vector<double> times = timesOf(run(drifting(), 1, kDt));
  ASSERT_EQ(times.size(), 241U) << "240 steps and the end";
  for (std::size_t k = 0; k < times.size(); ++k) {
    ASSERT_EQ(times[k], static_cast<double>(k) * kDt);
  }
  EXPECT_EQ(times.back(), 1);
}

// 600 · (1/60) rounds to 10, but 0.1 · 3 does not to 0.3, and 49 · (1/49) falls short of 1.
TEST(Loop1997, endsAtTheDurationWithoutASliverOfAStep) {
  EXPECT_EQ(timesOf(run(drifting(), 10, 1.0 / 60)).size(), 601U);
  EXPECT_EQ(timesOf(run(drifting(), 0.3, 0.1)), (std::vector<double>{0, 0.1, 0.2, 0.3}));
  ASSERT_LT(49 * (1.0 / 49), 1);
  const std::vector<double> times = timesOf(run(drifting(), 1, 1.0 / 49));
  EXPECT_EQ(times.size(), 50U);
  EXPECT_EQ(times.back(), 1);
}

TEST(Loop1997, endsWithAShorterStepWhereDtDoesNotDivideTheDuration) {
  const Memory memory = run(drifting(), 1, 0.375);
  EXPECT_EQ(timesOf(memory), (std::vector<double>{0, 0.375, 0.75, 1}));
  EXPECT_EQ(memory.last().pose.position, Vec3(0.25, 0, 0));
}

TEST(Loop1997, takesOneStepWhereDtIsLongerThanTheRun) {
  const Memory memory = run(drifting(), 1, 30);
  EXPECT_EQ(timesOf(memory), (std::vector<double>{0, 1}));
  EXPECT_EQ(memory.last().pose.position, Vec3(0.25, 0, 0));
}

TEST(Loop1997, recordsTheStartOfARunOfNoLength) {
  const Memory memory = run(drifting(), 0, 0.1);
  EXPECT_EQ(timesOf(memory), std::vector<double>{0});
  EXPECT_EQ(memory.last().velocity, Vec3(0.25, 0, 0));
}

// What one step leads to is where the next begins, to the bit, but for impulses.
TEST(Loop1997, recordsStepsThatJoin) {
  World world = sampleRoom(makeBox({.halfExtents = {0.1, 0.2, 0.3},
                                    .velocity = {3, 2, 1},
                                    .angularVelocity = {1, 2, 3},
                                    .restitution = 1}));
  world.gravity = {0, 0, -10};
  world.drag = Drag{.linear = 0.04, .angular = 0.01};
  const Memory memory = run(world, 3, 1.0 / 60);
  ASSERT_GE(memory.impacts.size(), 2U) << "measured 21";
  for (std::size_t i = 0; i + 1 < memory.moved.size(); ++i) {
    const BodyState here = stateAt(memory.moved[i].motion, world.bodies[0].mass,
                                   memory.moved[i + 1].time - memory.moved[i].time);
    const BodyState next = stateAt(memory.moved[i + 1].motion, world.bodies[0].mass, 0);
    ASSERT_EQ(here.pose.position, next.pose.position);
    ASSERT_EQ(here.pose.worldFromBody, next.pose.worldFromBody);
  }
}

TEST(Loop1997, bringsNothingUpToAnEmptyWorld) {
  const Memory memory = run(World{}, 1, 0.1);
  EXPECT_TRUE(memory.moved.empty());
  EXPECT_TRUE(memory.impacts.empty());
}

TEST(Loop1997, leavesHeldBodiesWhereTheyAre) {
  World world = sampleRoom(makeBox({.velocity = {1, 2, 3}, .angularVelocity = {1, 2, 3}}));
  world.bodies[0].mass = immovable();
  world.bodies[0].initial.pose.position = {4, 0, 0};  // half inside the wall
  world.bodies.push_back(makeBox({.name = "free"}));
  world.gravity = {0, 0, -10};
  const Memory memory = run(world, 0.5, 0.1);
  ASSERT_EQ(timesOf(memory, 0), std::vector<double>{0}) << "told once";
  EXPECT_TRUE(std::holds_alternative<Rest>(memory.moved[0].motion));
  EXPECT_EQ(memory.last(0).pose.position, Vec3(4, 0, 0));
  EXPECT_LT(memory.last(1).pose.position.z(), -0.5);
}

TEST(Loop1997, letsSpringsPullOnHeldBodies) {
  World world;
  world.bodies = {makeBox({.name = "post"}), makeBox({.position = {2, 0, 0}, .name = "free"})};
  world.bodies[0].mass = immovable();
  world.springs = {{.from = {.body = 0}, .to = {.body = 1}, .stiffness = 1}};
  Memory memory = run(world, 0.1, 0.01);
  EXPECT_LT(memory.last(1).velocity.x(), -1) << "measured -7.4";
  EXPECT_EQ(memory.last(0).pose.position, Vec3::Zero());

  // Whatever velocity it was given, it is held: damping sees it stand still.
  world.springs[0].damping = 0.1;
  memory = run(world, 0.1, 0.01);
  world.bodies[0].initial.velocity = {100, 0, 0};
  EXPECT_EQ(run(world, 0.1, 0.01).last(1).velocity, memory.last(1).velocity);
}

TEST(Loop1997, reportsAnImpactOnTheWayDown) {
  World world;
  world.walls = {floorAt(0)};
  world.bodies = {onItsCorner(1, 0.5)};
  world.bodies[0].initial.velocity = {0, 0, -4};
  const Memory memory = run(world, 0.375, 1.0 / 64);
  ASSERT_EQ(memory.impacts.size(), 1U);
  const Impact& impact = memory.impacts[0];
  EXPECT_NEAR(impact.time, 0.25, 0.001 / 4) << "within the layer";
  EXPECT_NEAR(impact.approach, 4, 1e-14);
  EXPECT_NEAR(impact.impulse, 1.5 * 4 * 0.0256, 1e-15) << "(1+e) M v";
  EXPECT_EQ(impact.normal, Vec3::UnitZ());
  EXPECT_NEAR(impact.point.z(), 0, kTouchingDepth);
  EXPECT_NEAR(memory.last().velocity.z(), 2, 1e-14) << "e times the speed before";
}

// Position is linear between impacts, so the moment found is where the halving led: 1/64 s before, halves of
// it after.
TEST(Loop1997, findsTheImpactByHalvingTheTime) {
  World world;
  world.walls = {floorAt(0)};
  world.bodies = {onItsCorner(1.0 + 4.0 / 128, 1)};  // touches in the middle of a step of 1/64 s
  world.bodies[0].initial.velocity = {0, 0, -4};
  const Memory memory = run(world, 0.5, 1.0 / 64);
  ASSERT_EQ(memory.impacts.size(), 1U);
  EXPECT_EQ(memory.impacts[0].time, 16.0 / 64 + 1.0 / 128);
}

/// The same throw at the wall on +x, or at that on −x, in a room wide enough never to meet another.
World thrownAt(double side, const Vec3& shift) {
  World world;
  world.walls = {
      {.name = "wall", .normal = -side * Vec3::UnitX(), .offset = -2 - side * shift.x(), .material = {}}};
  const Mat3 mirror = Vec3(side, 1, 1).asDiagonal();
  const Mat3 turned = orthonormalizeFromColumn0(axisAngle(Vec3(2, -1, 2) / 3, 1.1));
  world.bodies = {makeBox({.halfExtents = {0.1, 0.2, 0.3},
                           .position = mirror * Vec3(0.1, 0.2, 0.3) + shift,
                           .worldFromBody = mirror * turned * mirror,
                           .velocity = mirror * Vec3(3, 1, 0.5),
                           // A turn is mirrored with the opposite sign: side = det(mirror).
                           .angularVelocity = side * (mirror * Vec3(3, -1, 2)),
                           .restitution = 0.75})};
  return world;
}

TEST(Loop1997, mirrorsAThrowToTheBit) {
  const Memory right = run(thrownAt(1, Vec3::Zero()), 2, 1.0 / 60);
  const Memory left = run(thrownAt(-1, Vec3::Zero()), 2, 1.0 / 60);
  ASSERT_GE(right.impacts.size(), 1U) << "measured 2";
  ASSERT_EQ(left.impacts.size(), right.impacts.size());
  for (std::size_t i = 0; i < right.impacts.size(); ++i) {
    EXPECT_EQ(left.impacts[i].time, right.impacts[i].time);
    EXPECT_EQ(left.impacts[i].impulse, right.impacts[i].impulse);
  }
  const Mat3 mirror = Vec3(-1, 1, 1).asDiagonal();
  EXPECT_EQ(left.last().pose.position, Vec3(mirror * right.last().pose.position));
  EXPECT_EQ(left.last().pose.worldFromBody, Mat3(mirror * right.last().pose.worldFromBody * mirror));
  EXPECT_EQ(left.last().velocity, Vec3(mirror * right.last().velocity));
  EXPECT_EQ(left.last().angularMomentum, Vec3(-(mirror * right.last().angularMomentum)));
}

TEST(Loop1997, doesNotCareWhereTheRoomStands) {
  const Vec3 shift(64, -32, 16);
  const Memory here = run(thrownAt(1, Vec3::Zero()), 2, 1.0 / 60);
  const Memory there = run(thrownAt(1, shift), 2, 1.0 / 60);
  ASSERT_EQ(there.impacts.size(), here.impacts.size());
  EXPECT_NEAR(there.impacts[0].impulse, here.impacts[0].impulse, 1e-13);  // measured 9.7e-17
  EXPECT_LT((there.last().pose.position - shift - here.last().pose.position).norm(),
            1e-12);  // measured 1.8e-13
  EXPECT_LT((there.last().pose.worldFromBody - here.last().pose.worldFromBody).norm(),
            1e-12);  // measured 1.3e-13
}

// Explicit Euler on ẍ = −(k/m) x multiplies x + i v/ω₀ by 1 − i ω₀ h each step (ω₀² = k/m): amplitude
// (1 + ω₀² h²)^{n/2}, phase n · atan(ω₀ h).
TEST(Loop1997, swingsOnASpringAsEulerMust) {
  constexpr double kDt = 0.01;
  World world;
  world.bodies = {makeBox({.position = {1.5, 0, 0}})};
  const double frequency = 3;
  world.springs = {{.from = {.body = 0},
                    .to = {.body = {}, .point = {0, 0, 0}},
                    .stiffness = frequency * frequency * world.bodies[0].mass.mass}};
  const BodyState end = run(world, 4, kDt).last();
  const double amplitude = 1.5 * std::pow(1 + std::pow(frequency * kDt, 2), 200);
  const double phase = 400 * std::atan(frequency * kDt);
  EXPECT_NEAR(end.pose.position.x(), amplitude * std::cos(phase), 1e-12);          // measured 3.1e-14
  EXPECT_NEAR(end.velocity.x(), -frequency * amplitude * std::sin(phase), 1e-12);  // measured 5.7e-14
}

// The true period, 2π sqrt(m/k), is met with the error of first order that the amplitude has.
TEST(Loop1997, comesBackAfterThePeriodOfItsSpring) {
  World world;
  world.bodies = {makeBox({.position = {1.5, 0, 0}})};
  world.springs = {{.from = {.body = 0}, .to = {.body = {}, .point = {0, 0, 0}}, .stiffness = 0.7}};
  const double period = 2 * std::acos(-1.0) * std::sqrt(0.0256 / 0.7);
  const auto missed = [&](int steps) {
    return (run(world, period, period / steps).last().pose.position - Vec3(1.5, 0, 0)).norm();
  };
  EXPECT_NEAR(std::log2(missed(2000) / missed(4000)), 1, 0.1);  // measured 1.0036
  EXPECT_LT(missed(4000), 0.01);                                // measured 0.0074
}

// v̇ = −(c/m) v: Euler's factor per step is 1 − h c/m, the truth's exp(−h c/m).
TEST(Loop1997, slowsDownByDragAsEulerMust) {
  World world;
  world.bodies = {makeBox({.velocity = {2, 0, 0}, .angularVelocity = {0, 0, 3}})};
  const double inertia = world.bodies[0].mass.inertiaBody.z();
  world.drag = Drag{.linear = 0.04, .angular = inertia};
  const double rate = 0.04 / 0.0256;
  const auto speed = [&](int steps) { return run(world, 1, 1.0 / steps).last().velocity.x(); };
  EXPECT_NEAR(speed(100), 2 * std::pow(1 - rate / 100, 100), 1e-14);  // measured 3.9e-16
  const double truth = 2 * std::exp(-rate);
  EXPECT_NEAR(std::log2((speed(400) - truth) / (speed(800) - truth)), 1, 0.1);  // measured 1.0008
  const BodyState end = run(world, 1, 0.01).last();
  EXPECT_NEAR(angularVelocity(world.bodies[0].mass, end).z(), 3 * std::pow(0.99, 100), 1e-14);  // measured 0
}

// mẍ + cẋ + kx = 0 has solutions exp(λt), λ = −γ ± iω with γ = c/2m, ω² = k/m − γ²; Euler turns exp(λt) into
// (1 + hλ)ⁿ.
TEST(Loop1997, diesDownOnADampedSpringAsEulerMust) {
  using namespace std::complex_literals;
  constexpr double kMass = 0.0256;
  World world;
  world.bodies = {makeBox({.position = {1.5, 0, 0}})};
  world.springs = {
      {.from = {.body = 0}, .to = {.body = {}, .point = {0, 0, 0}}, .stiffness = 0.7, .damping = 0.1}};
  const double gamma = 0.1 / (2 * kMass);
  const double omega = std::sqrt(0.7 / kMass - gamma * gamma);
  const std::complex<double> lambda = -gamma + 1i * omega;
  // Let go at rest: Re C = 1.5 and Re Cλ = 0.
  const std::complex<double> c = 1.5 * (1.0 - 1i * gamma / omega);
  const std::complex<double> end = c * std::pow(1.0 + 0.001 * lambda, 1000);
  EXPECT_NEAR(run(world, 1, 0.001).last().pose.position.x(), end.real(), 1e-13);  // measured 1.2e-15
  EXPECT_LT(std::abs(end), 0.3) << "measured 0.23: it dies down";
}

TEST(Loop1997, refusesAStartInsideAWall) {
  World world = sampleRoom(makeBox({.position = {0, 0, -3.9}, .name = "sunk"}));
  const std::string message = failureOf(world, 1, 0.01);
  EXPECT_EQ(message,
            "at 0 s box sunk at wall room-z, its corner 100 mm behind it: the run cannot start from there; "
            "move the box "
            "out");
  world.bodies[0].initial.velocity = {0, 0, 50};
  EXPECT_EQ(failureOf(world, 1, 0.01), message) << "even if the first step would lead out";
}

TEST(Loop1997, startsOnTheWallWithinTheLayer) {
  World world = sampleRoom(makeBox({.position = {0, 0, -3.8005}, .velocity = {0, 0, 1}}));
  Memory memory;
  const RunFigures figures =
      simulate(world, {.method = Method::kListing1, .duration = 1, .dt = 0.01}, memory);
  EXPECT_NEAR(figures.deepestPenetration, 0.0005, 1e-15);
  EXPECT_TRUE(memory.impacts.empty());
}

TEST(Loop1997, saysWhenAStateIsNoLongerFinite) {
  const WithoutTraps overflowIsTheTest;
  World world;
  world.bodies = {makeBox({.position = {1, 0, 0}, .name = "bursting"})};
  world.springs = {{.from = {.body = 0}, .to = {.body = {}, .point = {0, 0, 0}}, .stiffness = 1e200}};
  const std::string message = failureOf(world, 1, 0.01);
  EXPECT_NE(message.find("box bursting: its state is not finite"), std::string::npos) << message;
}

TEST(Loop1997, stopsWhenAsked) {
  const World world = drifting();
  std::stop_source source;
  Memory memory;
  memory.onMove = [&] {
    if (memory.moved.size() == 3) {
      source.request_stop();
    }
  };
  EXPECT_THROW(
      simulate(world, {.method = Method::kListing1, .duration = 1, .dt = 0.01}, memory, source.get_token()),
      Interrupted);
  EXPECT_EQ(memory.moved.size(), 3U) << "no step after the wish";
}

TEST(Loop1997, knowsNoContactBetweenBoxes) {
  World world;
  world.bodies = {makeBox({.position = {-1, 0, 0}, .velocity = {1, 0, 0}}),
                  makeBox({.position = {1, 0, 0}, .velocity = {-1, 0, 0}})};
  const Memory memory = run(world, 2, 0.125);
  EXPECT_TRUE(memory.impacts.empty());
  EXPECT_EQ(memory.last(0).pose.position, Vec3(1, 0, 0)) << "through each other";
}

TEST(Loop1997, givesTheSameBitsTwice) {
  World world = sampleRoom(makeBox({.halfExtents = {0.1, 0.2, 0.3},
                                    .velocity = {3, 2, 1},
                                    .angularVelocity = {1, 2, 3},
                                    .restitution = 1}));
  const Memory first = run(world, 5, 1.0 / 60);
  const Memory second = run(world, 5, 1.0 / 60);
  ASSERT_EQ(first.moved.size(), second.moved.size());
  EXPECT_EQ(first.last().pose.position, second.last().pose.position);
  EXPECT_EQ(first.last().pose.worldFromBody, second.last().pose.worldFromBody);
}

}  // namespace
}  // namespace careen
