// What the published method really does: PHYSICS.md's table, the baseline every better method is measured by.
// These are facts about the method, good and bad; a change here means that it is no longer the method of
// 1997.

#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "core/error.h"
#include "physics/simulate.h"
#include "physics/world/diagnostics.h"
#include "physics/world/method.h"
#include "support/free_top.h"
#include "support/physics_worlds.h"

namespace careen {
namespace {

struct Outcome {
  Memory memory;
  RunFigures figures;
  double energyRatio = 0;   ///< E/E₀, heights measured from the floor of the world
  double kineticRatio = 0;  ///< of the kinetic energy alone
};

Outcome outcomeOf(const World& world, double duration, double dt) {
  Outcome result;
  result.figures =
      simulate(world, {.method = Method::kListing1, .duration = duration, .dt = dt}, result.memory);
  const Energy before = energyOf(world, std::vector<BodyState>{world.bodies[0].initial});
  const Energy after = energyOf(world, std::vector<BodyState>{result.memory.last()});
  result.energyRatio = after.total() / before.total();
  if (before.kinetic > 0) {
    result.kineticRatio = after.kinetic / before.kinetic;
  }
  return result;
}

World alone(Body body) {
  World world;
  world.bodies = {std::move(body)};
  return world;
}

// Half sizes (.1, .2, .3), ω = (1, 2, 3), 5 s, dt 0.01: E/E₀ 1.241, 97° off.
TEST(PublishedMethod, givesATumblingBoxAQuarterMoreEnergy) {
  const World world = alone(makeBox({.halfExtents = {0.1, 0.2, 0.3}, .angularVelocity = {1, 2, 3}}));
  const Outcome result = outcomeOf(world, 5, 0.01);
  EXPECT_NEAR(result.energyRatio, 1.241, 0.002);           // measured 1.2409
  EXPECT_NEAR(result.figures.energyChange, 0.241, 0.002);  // measured 0.2409: the run says so itself

  FreeTop top(world.bodies[0].mass.inertiaBody, world.bodies[0].initial.angularMomentum);
  top.advance(5, 20000);
  const double off = angleBetween(top.worldFromBody(), result.memory.last().pose.worldFromBody);
  EXPECT_NEAR(off * 180 / std::numbers::pi, 97, 1);  // measured 97.09
  EXPECT_EQ(result.figures.momentumChange, 0) << "L stays for ever: energy and attitude are what goes wrong";
}

// Needle, half sizes (.005, .005, .5), ω = (1, .1, 100), 5 s, dt 1/60: E/E₀ 190.
TEST(PublishedMethod, multipliesTheEnergyOfANeedle) {
  const World world = alone(makeBox({.halfExtents = {0.005, 0.005, 0.5}, .angularVelocity = {1, 0.1, 100}}));
  EXPECT_NEAR(outcomeOf(world, 5, 1.0 / 60).energyRatio, 190, 1);  // measured 190.25
}

// A cube of half size 0.1 let go flat 1 m over the floor, g = 10, e = 1, 20 s, dt 1/60: E/E₀ 2.50, heights of
// the centre from the floor. Each step of free fall makes ½ m g² h²: at full steps 1 + ½ g h t/z₀ = 2.52.
TEST(PublishedMethod, letsABouncingCubeRiseEverHigher) {
  World world = alone(makeBox({.halfExtents = {0.1, 0.1, 0.1}, .position = {0, 0, 1.1}, .restitution = 1}));
  world.walls = {floorAt(0)};
  world.gravity = {0, 0, -10};
  const Outcome result = outcomeOf(world, 20, 1.0 / 60);
  EXPECT_NEAR(result.energyRatio, 2.50, 0.005);  // measured 2.5006
}

/// A cube falling flat at 4.5 m/s; it strikes after about a tenth of a second.
World flatLanding(double restitution) {
  World world =
      alone(makeBox({.position = {0, 0, 0.65}, .velocity = {0, 0, -4.5}, .restitution = restitution}));
  world.walls = {floorAt(0)};
  return world;
}

// e = 0.5: 31 % of the kinetic energy where 25 % should be left, and spin where there should be none. Each
// corner in turn is sent back at half its speed, but the later ones set the earlier in motion again.
TEST(PublishedMethod, landsAFlatCubeSpinning) {
  const World world = flatLanding(0.5);
  const Outcome result = outcomeOf(world, 0.15, 1.0 / 60);
  EXPECT_EQ(result.memory.impacts.size(), 5U);
  EXPECT_NEAR(result.kineticRatio, 0.31, 0.005);  // measured 0.3096
  const double spin = angularVelocity(world.bodies[0].mass, result.memory.last()).norm();
  EXPECT_GT(spin, 1) << "measured 1.7 rad/s";
}

// e = 0: no number of single impulses brings four corners to rest, each leaves a rest of speed at another.
TEST(PublishedMethod, givesUpOnAFlatLandingWithoutRestitution) {
  const World world = flatLanding(0);
  Memory memory;
  try {
    simulate(world, {.method = Method::kListing1, .duration = 1, .dt = 1.0 / 60}, memory);
    FAIL() << "it ended";
  } catch (const NumericalError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("box crate at wall floor"), std::string::npos) << message;
    EXPECT_NE(message.find("100 impulses at one moment"), std::string::npos) << message;
    EXPECT_NE(message.find("the 1997 method cannot let a box rest"), std::string::npos) << message;
  }
  EXPECT_EQ(memory.impacts.size(), 100U);
  EXPECT_NEAR(memory.impacts.front().time, 0.1, 0.001);
}

// Room, g = 10, e = 0: the first landing is the end. A corner pressed on the floor is carried deeper by the
// turning of the box, step by step, until no step is short enough to keep it above the layer's bottom.
TEST(PublishedMethod, isStuckHalvingAtALandingWithoutRestitution) {
  World world = sampleRoom(makeBox({.velocity = {1, 2, 3}, .angularVelocity = {1, 2, 3}}));
  world.gravity = {0, 0, -10};
  Memory memory;
  try {
    simulate(world, {.method = Method::kListing1, .duration = 10, .dt = 1.0 / 60}, memory);
    FAIL() << "it ended";
  } catch (const NumericalError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("at 1.41635 s box crate at wall room-z, its corner 1 mm behind it"),
              std::string::npos)
        << message;
    EXPECT_NE(message.find("every step longer than 1e-05 s penetrates that far"), std::string::npos)
        << message;
  }
  EXPECT_GT(memory.impacts.front().time, 1.2) << "measured 1.22: it had just landed";
}

// Which of its two ends it meets, halving or the cap, hangs on the last bits; that it meets one does not.
TEST(PublishedMethod, cannotRestInTheRoomWhateverTheThrow) {
  int halving = 0;
  int capped = 0;
  for (int i = 0; i < 40; ++i) {
    World world = sampleRoom(makeBox({.halfExtents = Vec3::Constant(0.3),
                                      .velocity = {0.1 * i, 1, 2 - 0.1 * i},
                                      .angularVelocity = {1, 2, 3}}));
    world.gravity = {0, 0, -10};
    Memory memory;
    try {
      simulate(world, {.method = Method::kListing1, .duration = 10, .dt = 1.0 / 60}, memory);
    } catch (const NumericalError& error) {
      const bool stuck = std::string(error.what()).find("every step longer") != std::string::npos;
      (stuck ? halving : capped) += 1;
    }
  }
  EXPECT_EQ(halving + capped, 40);
  EXPECT_GE(halving, 1);  // measured 9
  EXPECT_GE(capped, 1);   // measured 31
}

// Room, g = 0, e = 1, 10 s, dt 1/60: E/E₀ 0.659. Half sizes (.3, .2, .1), v = (3, 2, 1), ω = (1, 2, 3).
TEST(PublishedMethod, losesAThirdOfTheEnergyInAnElasticRoom) {
  const World world = sampleRoom(makeBox({.halfExtents = {0.3, 0.2, 0.1},
                                          .velocity = {3, 2, 1},
                                          .angularVelocity = {1, 2, 3},
                                          .restitution = 1}));
  const Outcome result = outcomeOf(world, 10, 1.0 / 60);
  EXPECT_NEAR(result.energyRatio, 0.659, 0.001);  // measured 0.6585
  EXPECT_EQ(result.memory.impacts.size(), 8U);
}

}  // namespace
}  // namespace careen
