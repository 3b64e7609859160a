#include "physics/compared/stepped_world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.h"
#include "physics/attitude/free_methods.h"
#include "physics/world/method.h"
#include "support/exact_runs.h"
#include "support/free_runs.h"

namespace careen {
namespace {

Recorded runBy(const World& world, Method method, double duration, double dt) {
  Recorded run;
  run.motions.resize(world.bodies.size());
  Notes notes(run);
  run.figures = runStepped(world, {.method = method, .duration = duration, .dt = dt}, notes, {});
  return run;
}

std::string nameOf(const FreeMethod& method) { return std::string(traitsOf(method.method).name); }

double worstTimeOfImpact(const Recorded& run, const Recorded& truth, std::size_t count) {
  double worst = 0;
  for (std::size_t i = 0; i < count; ++i) {
    worst = std::max(worst, std::fabs(run.impacts.at(i).time - truth.impacts.at(i).time));
  }
  return worst;
}

TEST(SteppedWorld, comesToTheImpactsOfExactWithItsOwnOrder) {
  const World world = elasticRoom();
  const Recorded truth = runFor(world, 2);
  for (const FreeMethod& method : freeMethods()) {
    const int order = traitsOf(method.method).order;
    // Coarse, so that high orders are not yet at rounding.
    const double dt = order == 2 ? 1.0 / 480 : order == 4 ? 1.0 / 240 : order < 10 ? 1.0 / 32 : 1.0 / 16;
    const double coarse = worstTimeOfImpact(runBy(world, method.method, 2, dt), truth, 4);
    const double fine = worstTimeOfImpact(runBy(world, method.method, 2, dt / 4), truth, 4);
    // Steps cut short at impacts blur it: measured 2.0, 4.0, 5.9, 7.7 and 10.5.
    EXPECT_NEAR(std::log2(coarse / fine) / 2, order, 0.8) << nameOf(method);
  }
}

TEST(SteppedWorld, bouncesAFlatCubeAsHighAsItFellFrom) {
  World world;
  world.gravity = Vec3(0, 0, -10);
  world.walls = {wall("floor", Vec3(0, 0, 1), 0)};
  world.bodies = {box("cube", Vec3(0.5, 0.5, 0.5), 1, Vec3(0, 0, 1.75))};
  for (const FreeMethod& method : freeMethods()) {
    // Back where it began, after 100 bounces: 2 sqrt(2h/g) = 1 s each.
    const Recorded run = runBy(world, method.method, 100, 1.0 / 60);
    EXPECT_EQ(run.moments(), 100U) << nameOf(method);
    const BodyState last = run.last(world, 0, 100);
    EXPECT_NEAR(last.pose.position.z(), 1.75, 1e-14) << nameOf(method);  // measured 7e-16
    EXPECT_EQ(last.angularMomentum, Vec3(0, 0, 0)) << nameOf(method);
    EXPECT_LT(run.figures.energyChange, 1e-14) << nameOf(method);        // measured 1.1e-15
    EXPECT_LT(run.figures.deepestPenetration, 1e-14) << nameOf(method);  // measured 7e-16
  }
}

TEST(SteppedWorld, turnsAFreeBodyByTheStepsOfItsMethod) {
  World world;
  world.bodies = {box("book", Vec3(0.1, 0.2, 0.3), 1, Vec3::Zero(), Vec3(1, 2, 3), Vec3(1, 2, 3))};
  const double dt = 1.0 / 64;
  for (const FreeMethod& method : freeMethods()) {
    const Recorded run = runBy(world, method.method, 5.5 * dt + 200 * dt, dt);
    FreeState<double> expected{Quat::Identity(), world.bodies[0].initial.angularMomentum};
    method.steps(world.bodies[0].mass.inertiaBody, expected, dt, 205);
    method.steps(world.bodies[0].mass.inertiaBody, expected, dt / 2, 1);
    const BodyState last = run.last(world, 0, 205.5 * dt);
    // measured 0 to 8e-15, for what is recorded is the momentum in the world
    EXPECT_LT((last.pose.worldFromBody - expected.worldFromBody.toRotationMatrix()).norm(), 2e-14)
        << nameOf(method);
    EXPECT_LT((last.pose.position - 205.5 * dt * Vec3(1, 2, 3)).norm(), 1e-14) << nameOf(method);
    // Far from any wall steps are taken many at a time.
    EXPECT_LT(run.motions[0].size(), 12U) << nameOf(method);
  }
}

TEST(SteppedWorld, keepsNoPenetrationAndTheMomentumItGets) {
  World world = elasticRoom();
  world.walls[4].material.friction = 0.2;
  world.bodies[0].material = {.restitution = 0.9, .friction = 0.2};
  const Recorded run = runBy(world, Method::kTaylor8, 10, 1.0 / 240);
  EXPECT_GT(run.impacts.size(), 30U);
  EXPECT_TRUE(std::any_of(run.impacts.begin(), run.impacts.end(),
                          [](const Impact& impact) { return impact.tangential > 0; }));
  EXPECT_LT(run.figures.deepestPenetration, 1e-13);  // measured 7e-15
  EXPECT_LT(run.figures.energyChange, 1e-13);        // measured 1.2e-15
  EXPECT_LT(run.figures.momentumChange, 1e-12);      // measured 7e-14
}

TEST(SteppedWorld, tellsTheMomentumAndTheEnergyThatTheMethodLoses) {
  World world;
  world.bodies = {box("book", Vec3(0.1, 0.2, 0.3), 1, Vec3::Zero(), Vec3::Zero(), Vec3(1, 2, 3))};
  const RunFigures poor = runBy(world, Method::kRungeKutta4, 100, 0.1).figures;
  EXPECT_GT(poor.momentumChange, 1e-4);  // measured 1.8e-4
  EXPECT_GT(poor.energyChange, 1e-4);    // measured 2.4e-4
  const RunFigures good = runBy(world, Method::kMoserVeselov10, 100, 0.1).figures;
  EXPECT_LT(good.momentumChange, 1e-13);  // measured 7e-15
  EXPECT_LT(good.energyChange, 1e-13);    // measured 3e-15
}

TEST(SteppedWorld, saysThatItCannotRest) {
  World world;
  world.gravity = Vec3(0, 0, -10);
  world.walls = {wall("floor", Vec3(0, 0, 1), 0, 0.5)};
  world.bodies = {box("cube", Vec3(0.5, 0.5, 0.5), 1, Vec3(0, 0, 1.5), Vec3::Zero(), Vec3::Zero(), 0.5)};
  try {
    runBy(world, Method::kStrang, 3, 1.0 / 240);
    FAIL() << "came to rest";
  } catch (const NumericalError& error) {
    // The closed form comes to rest at 1.342 s.
    EXPECT_TRUE(std::string(error.what()).starts_with("at 1.34164 s box cube would have to rest"))
        << error.what();
  }
}

TEST(SteppedWorld, listsTheImpactsOfAllBodiesInOrderOfTime) {
  World world = elasticRoom();
  world.bodies.push_back(world.bodies[0]);
  world.bodies[1].name = "second";
  world.bodies[1].initial.velocity = Vec3(-2, 3, 0);
  const Recorded run = runBy(world, Method::kTaylor8, 5, 1.0 / 240);
  EXPECT_TRUE(std::is_sorted(run.impacts.begin(), run.impacts.end(),
                             [](const Impact& a, const Impact& b) { return a.time < b.time; }));
  for (const int body : {0, 1}) {
    EXPECT_TRUE(std::any_of(run.impacts.begin(), run.impacts.end(),
                            [body](const Impact& impact) { return impact.a.value == body; }));
  }
}

TEST(SteppedWorld, stopsWhenAskedTo) {
  std::stop_source source;
  source.request_stop();
  const World world = elasticRoom();
  Recorded run;
  run.motions.resize(1);
  Notes notes(run);
  EXPECT_THROW(runStepped(world, {.method = Method::kStrang, .duration = 1}, notes, source.get_token()),
               Interrupted);
}

}  // namespace
}  // namespace careen
