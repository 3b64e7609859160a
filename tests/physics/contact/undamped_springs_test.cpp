// Oscillations that nothing damps: energy stays to rounding, however long and however stiff. Each fails if
// UndampedSprings::keep does nothing.
#include "physics/contact/undamped_springs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "physics/world/forces.h"
#include "support/exact_runs.h"
#include "support/impact_scene.h"

namespace careen {
namespace {

// What a world has where its first body's motions begin.
struct Drift {
  double energy = 0;  // [1] largest deviation, of the largest kinetic and spring energy
  double spin = 0;    // [1] of angular momentum about the origin, of its largest share
};

Drift driftOf(const World& world, const Recorded& run) {
  Drift drift;
  double first = 0;
  Vec3 firstSpin;
  double scale = 0;
  double spinScale = 0;
  const std::vector<std::pair<double, Motion>>& motions = run.motions[0];
  for (std::size_t k = 0; k < motions.size(); k += 1 + motions.size() / 2000) {
    std::vector<BodyState> states;
    double energy = 0;
    double kinetic = 0;
    Vec3 spin = Vec3::Zero();
    for (std::size_t body = 0; body < world.bodies.size(); ++body) {
      states.push_back(run.at(world, body, motions[k].first));
      const BodyState& state = states.back();
      const MassProperties& mass = world.bodies[body].mass;
      kinetic += kineticEnergy(mass, state);
      energy -= mass.mass * world.gravity.dot(state.pose.position);
      const Vec3 orbital = mass.mass * state.pose.position.cross(state.velocity);
      spin += orbital + state.angularMomentum;
      spinScale = std::max({spinScale, orbital.norm(), state.angularMomentum.norm()});
    }
    const double springs = springEnergy(world, states);
    energy += kinetic + springs;
    scale = std::max(scale, kinetic + springs);
    first = k == 0 ? energy : first;
    firstSpin = k == 0 ? spin : firstSpin;
    drift.energy = std::max(drift.energy, std::fabs(energy - first));
    drift.spin = std::max(drift.spin, (spin - firstSpin).norm());
  }
  return {.energy = drift.energy / scale, .spin = spinScale > 0 ? drift.spin / spinScale : 0};
}

// A cube of 1 kg on one spring to the world, `amplitude` [m] beside its rest: x = 0.5 + a cos(√k t).
World oscillator(double stiffness, double amplitude) {
  World world;
  world.bodies.push_back(box("a", Vec3::Constant(0.1), 1, Vec3(0.5 + amplitude, 0, 0)));
  world.springs.push_back({.from = {.body = 0}, .to = {}, .stiffness = stiffness, .restLength = 0.5});
  return world;
}
double periodOf(double stiffness) { return 2 * std::numbers::pi / std::sqrt(stiffness); }

// Measured 8e-16 to 3e-14; without it .002 to .5, and the run of 600 s at k = 200 ended with exit code 4.
TEST(UndampedSprings, anOscillationKeepsItsEnergy) {
  for (const double stiffness : {1.0, 200.0, 1e4, 1e8}) {
    const double amplitude = std::min(0.2, 10 / std::sqrt(stiffness));
    const World world = oscillator(stiffness, amplitude);
    EXPECT_LT(driftOf(world, runFor(world, 1000 * periodOf(stiffness))).energy, 1e-12) << stiffness;
  }
}

// The place's error grows in proportion to time. Measured at a slope of the cosine: 8.3e-6 m after 135
// periods, 8.2e-5 m after 1350, 8.2e-4 m after 13500; without the energy twice that.
TEST(UndampedSprings, itsPlaceIsThatOfTheClosedForm) {
  const double stiffness = 200;
  const World world = oscillator(stiffness, 0.2);
  const double time = 1350.2 * periodOf(stiffness);
  const Recorded run = runFor(world, time);
  EXPECT_NEAR(run.last(world, 0, time).pose.position.x(), 0.5 + 0.2 * std::cos(std::sqrt(stiffness) * time),
              1.2e-4);
}

// Random bodies on springs at any of their points, free or tied to the world. Measured: 1e-13, spins 1e-14.
TEST(UndampedSprings, randomBodiesKeepEnergyAndMomenta) {
  test::Random random(53);
  for (int scene = 0; scene < 40; ++scene) {
    World world;
    const int count = 1 + scene % 6;
    const bool isFree = count > 1 && scene % 2 == 0;
    const double stiffness = std::pow(10, random.between(0, 8));
    const double amplitude = 0.1 * std::min(1.0, std::sqrt(1e4 / stiffness));
    world.gravity = isFree ? Vec3(0, 0, 0) : Vec3(0, 0, stiffness > 1e3 ? -9.81 : 0);
    for (int i = 0; i < count; ++i) {
      world.bodies.push_back(
          box("b" + std::to_string(i), Vec3(0.1, 0.15, 0.2), random.between(0.5, 4), Vec3(2. * i, 0, 0)));
      BodyState& state = world.bodies.back().initial;
      state.angularMomentum = angularMomentum(world.bodies.back().mass, state.pose.worldFromBody,
                                              std::min(1.0, 0.1 * std::sqrt(stiffness)) * random.inCube(1));
      if (i > 0) {
        world.springs.push_back({.from = {.body = i - 1, .point = 0.1 * random.inCube(1)},
                                 .to = {.body = i, .point = scene % 3 == 0 ? Vec3(0, 0, 0) : Vec3(0, 0.1, 0)},
                                 .stiffness = stiffness,
                                 .restLength = 2 + amplitude * random.between(-1, 1)});
      }
      if (!isFree) {
        world.springs.push_back({.from = {.body = i},
                                 .to = {.body = {}, .point = Vec3(2. * i, 0, 2)},
                                 .stiffness = stiffness,
                                 .restLength = 2 + amplitude * random.between(-1, 1)});
      }
    }
    const Recorded run = runFor(world, 20 * periodOf(stiffness));
    ASSERT_TRUE(run.impacts.empty()) << scene;
    const Drift drift = driftOf(world, run);
    EXPECT_LT(drift.energy, 1e-12) << scene << " k " << stiffness;
    if (isFree) {
      EXPECT_LT(drift.spin, 1e-11) << scene;
    }
  }
}

// What damping takes stays taken.
TEST(UndampedSprings, dampedOnesAreLeftAlone) {
  World world;
  world.bodies.push_back(box("a", Vec3::Constant(0.1), 1, Vec3(0.7, 0, 0)));
  world.springs.push_back({.from = {.body = 0}, .to = {}, .stiffness = 200, .damping = 1, .restLength = 0.5});
  const std::vector<TouchingBody> bodies = {{.body = &world.bodies[0], .index = 0}};
  EXPECT_TRUE(UndampedSprings(world, bodies).empty());
  world.springs[0].damping = 0;
  EXPECT_FALSE(UndampedSprings(world, bodies).empty());
  world.drag = Drag{.linear = 1};
  EXPECT_TRUE(UndampedSprings(world, bodies).empty());
}

}  // namespace
}  // namespace careen
