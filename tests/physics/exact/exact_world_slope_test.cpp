// Gravity that slopes, against closed forms: errors beside what was measured.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "physics/world/world.h"
#include "support/exact_runs.h"
#include "support/jointed.h"

namespace careen {
namespace {

constexpr double kWeight = 9.81;
const Vec3 kDown(0, 0, -kWeight);

World sloping(std::vector<GravityChange> path) {
  World world;
  world.gravity = path.front().gravity;
  path.erase(path.begin());
  world.gravityChanges = std::move(path);
  world.gravityPath = GravityPath::kLinear;
  return world;
}

World onFloor(const Vec3& halfExtents, double friction, std::vector<GravityChange> path) {
  World world = sloping(std::move(path));
  world.bodies = {box("box", halfExtents, 1, Vec3(0, 0, halfExtents.z()), Vec3::Zero(), Vec3::Zero(), 0)};
  world.bodies[0].material.friction = friction;
  world.walls = {wall("floor", Vec3::UnitZ(), 0, 0)};
  world.walls[0].material.friction = friction;
  return world;
}

// The first moment at which `of` is negative between two.
template <class Of>
double root(double low, double high, const Of& of) {
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (low + high);
    (of(middle) < 0 ? high : low) = middle;
  }
  return high;
}

TEST(ExactWorldSlope, flightIsOneCubicAfterAnother) {
  World world = sloping({{.time = 0, .gravity = kDown},
                         {.time = 1.5, .gravity = Vec3(3, 1, -2)},
                         {.time = 2, .gravity = Vec3(0, 0, 4)}});
  world.bodies = {box("box", Vec3(0.1, 0.2, 0.3), 1, Vec3(1, 2, 3), Vec3(1, 0, 4), Vec3(3, 4, 5))};
  const Recorded run = runFor(world, 3);
  Vec3 position(1, 2, 3);
  Vec3 velocity(1, 0, 4);
  double from = 0;
  Vec3 gravity = world.gravity;
  for (const GravityChange& to : {world.gravityChanges[0], world.gravityChanges[1],
                                  GravityChange{.time = 3, .gravity = Vec3(0, 0, 4)}}) {
    const double h = to.time - from;
    const Vec3 slope = (to.gravity - gravity) / h;
    for (const double s : {0.3 * h, h}) {
      const BodyState state = run.at(world, 0, from + s);
      const Vec3 due = position + s * velocity + (s * s / 2) * gravity + (s * s * s / 6) * slope;
      EXPECT_LT((state.pose.position - due).norm(), 4e-15) << from + s;
      EXPECT_LT((state.velocity - velocity - s * gravity - (s * s / 2) * slope).norm(), 4e-15) << from + s;
    }
    position += h * velocity + (h * h / 2) * gravity + (h * h * h / 6) * slope;
    velocity += h * gravity + (h * h / 2) * slope;
    gravity = to.gravity;
    from = to.time;
  }
  EXPECT_EQ(run.motions[0].size(), 3U);
  EXPECT_LT(run.figures.energyChange, 1e-14);
  EXPECT_LT(run.figures.momentumChange, 1e-14);
}

// From 2 m, under 1 + 4 t: at the root of 2 − t²/2 − 2 t³/3. Flat, and on a corner that does not turn.
TEST(ExactWorldSlope, landsAtTheRootOfACubic) {
  World world = onFloor(Vec3::Constant(0.1), 0.3,
                        {{.time = 0, .gravity = Vec3(0, 0, -1)}, {.time = 5, .gravity = Vec3(0, 0, -21)}});
  world.bodies[0].initial.pose.position.z() = 2.1;
  const double due = root(0, 5, [](double t) { return 2 - t * t * (0.5 + t * (2.0 / 3)); });
  const Recorded run = runFor(world, 2);
  ASSERT_FALSE(run.impacts.empty());
  EXPECT_NEAR(run.impacts[0].time, due, 1e-14 * due);
  EXPECT_NEAR(run.impacts[0].approach, due + 2 * due * due, 1e-14);
}

// Two that fly together have no gravity relative to each other, and one that is held has all of it.
TEST(ExactWorldSlope, boxesMeetAtTheRootOfACubic) {
  World world = sloping({{.time = 0, .gravity = Vec3(0, 0, -1)}, {.time = 5, .gravity = Vec3(0, 0, -21)}});
  const auto cube = [](const char* name, double z, double vz, double mass) {
    return box(name, Vec3::Constant(0.1), mass, Vec3(0, 0, z), Vec3(0, 0, vz), Vec3::Zero(), 1);
  };
  world.bodies = {cube("upper", 3, 0, 1), cube("lower", 1.8, 2, 1)};
  const Recorded together = runFor(world, 1);
  ASSERT_FALSE(together.impacts.empty());
  EXPECT_NEAR(together.impacts[0].time, 0.5, 1e-15);
  world.bodies[1] = cube("lower", 0.8, 0, 1);
  world.bodies[1].mass = immovable();
  const double due = root(0, 5, [](double t) { return 2 - t * t * (0.5 + t * (2.0 / 3)); });
  const Recorded held = runFor(world, 2);
  ASSERT_FALSE(held.impacts.empty());
  EXPECT_NEAR(held.impacts[0].time, due, 1e-14 * due);
}

// A table that is tilted: its load begins to slip where the slope is that of friction, 2.943 m/s² of 3 t, and
// then slides by (t − t₀)³/2. 3.5e-7 m and 1.1e-5 m/s off, of a tolerance of 1e-6 m.
TEST(ExactWorldSlope, slipsWhereTheTableIsAsSteepAsFriction) {
  const World world = onFloor(Vec3(0.4, 0.4, 0.1), 0.3,
                              {{.time = 0, .gravity = kDown}, {.time = 2, .gravity = Vec3(6, 0, -kWeight)}});
  const double slips = 0.3 * kWeight / 3;
  const Recorded run = runFor(world, 2);
  EXPECT_LT((run.at(world, 0, slips - 1e-6).pose.position - Vec3(0, 0, 0.1)).norm(), 4e-9);
  for (const double t : {1.0, 1.3, 2.0}) {
    const double s = t - slips;
    EXPECT_NEAR(run.at(world, 0, t).pose.position.x(), 0.5 * s * s * s, 1e-6) << t;
    EXPECT_NEAR(run.at(world, 0, t).velocity.x(), 1.5 * s * s, 4e-5) << t;
  }
}

// It brakes for .8 s, from nothing to .8 g and back: its load of friction .4 slips from where that is .4 g,
// goes on to where friction has stopped it again, and lies there. 6.7e-6 m and 2.8e-6 s off.
TEST(ExactWorldSlope, aLoadStopsWhereFrictionHasTakenItsSpeed) {
  const World world = onFloor(Vec3(0.4, 0.4, 0.1), 0.4,
                              {{.time = 0, .gravity = kDown},
                               {.time = 0.4, .gravity = Vec3(0.8 * kWeight, 0, -kWeight)},
                               {.time = 0.8, .gravity = kDown}});
  // From .2 s it gains 2 g (t − .2) until .4 s, then .4 g − 2 g (t − .4): as much from .4 to .6 s as before,
  // then loses g (t − .6)² until .8 s, and .4 g after that.
  const double gained = 0.08 * kWeight;
  const double left = gained - 0.04 * kWeight;
  const double stops = 0.8 + left / (0.4 * kWeight);
  const double way =
      kWeight * (0.008 / 3 + 0.04 * 0.2 + 0.2 * 0.2 * 0.2 - 0.008 / 3 + 0.08 * 0.2 - 0.008 / 3) +
      left * left / (2 * 0.4 * kWeight);
  const Recorded run = runFor(world, 2);
  EXPECT_NEAR(run.at(world, 0, 0.6).velocity.x(), gained, 4e-5);
  EXPECT_NEAR(run.at(world, 0, 0.8).velocity.x(), left, 4e-5);
  EXPECT_NEAR(run.last(world, 0, 2).pose.position.x(), way, 2e-5);
  EXPECT_TRUE(std::holds_alternative<Rest>(run.motions[0].back().second));
  EXPECT_NEAR(run.motions[0].back().first, stops, 1e-5);
}

// A block .2 m wide and 1 m high falls over from where gravity points beside its edge: tan = .2. 7e-8 rad
// off.
TEST(ExactWorldSlope, tipsWhereGravityPointsBesideItsEdge) {
  const World world = onFloor(Vec3(0.1, 0.2, 0.5), 2,
                              {{.time = 0, .gravity = kDown}, {.time = 2, .gravity = Vec3(6, 0, -kWeight)}});
  const double tips = 0.2 * kWeight / 3;
  const Recorded run = runFor(world, 1);
  EXPECT_LT((run.at(world, 0, tips - 1e-4).pose.worldFromBody - Mat3::Identity()).norm(), 2e-8);
  // About its edge, with J = 4/3 m (a² + b²): at first J θ'' = m b 3 (t − t₀).
  const double s = 0.02;
  const double arm = 0.01 + 0.25;
  const double turned = 0.5 * 3 * s * s * s / 6 / (4.0 / 3 * arm);
  const Mat3 turn = run.at(world, 0, tips + s).pose.worldFromBody;
  EXPECT_NEAR(std::asin(turn(0, 2)), turned, 0.05 * turned);
}

// Gravity that turns from down to up lifts what lies, where it is none: 1 s; then z = 9.81 s³/6.
TEST(ExactWorldSlope, liftsWhereGravityIsNone) {
  const World world =
      onFloor(Vec3(0.4, 0.4, 0.1), 0.3, {{.time = 0, .gravity = kDown}, {.time = 2, .gravity = -kDown}});
  const Recorded run = runFor(world, 2);
  EXPECT_NEAR(run.at(world, 0, 1).pose.position.z(), 0.1, 1e-14);
  for (const double s : {0.1, 0.5, 1.0}) {
    EXPECT_NEAR(run.at(world, 0, 1 + s).pose.position.z(), 0.1 + kWeight * s * s * s / 6, 1e-9) << s;
  }
}

// [m] How far the states of two worlds are apart at the end.
double apart(const World& a, const World& b, double time) {
  const Recorded ofA = runFor(a, time);
  const Recorded ofB = runFor(b, time);
  double most = 0;
  for (std::size_t body = 0; body < a.bodies.size(); ++body) {
    const BodyState x = ofA.last(a, body, time);
    const BodyState y = ofB.last(b, body, time);
    most = std::max({most, (x.pose.position - y.pose.position).norm(),
                     radiusOf(a.bodies[body]) * (x.pose.worldFromBody - y.pose.worldFromBody).norm()});
  }
  return most;
}

World thrown(std::vector<GravityChange> path) {
  World world = onFloor(Vec3(0.1, 0.15, 0.2), 0.4, std::move(path));
  world.bodies[0].initial.pose.position.z() = 0.6;
  world.bodies[0].initial.velocity = Vec3(1, 0.5, 0);
  world.bodies[0].initial.angularMomentum = Vec3(0.01, 0.02, -0.01);
  world.bodies[0].material.restitution = world.walls[0].material.restitution = 0.3;
  return world;
}

TEST(ExactWorldSlope, pathOfOneGravityIsThatGravity) {
  World constant = thrown({{.time = 0, .gravity = kDown}});
  constant.gravityPath = GravityPath::kSteps;
  const World path = thrown({{.time = 0, .gravity = kDown}, {.time = 1, .gravity = kDown}});
  EXPECT_LT(apart(constant, path, 2), 1e-6);
}

// 2.7e-5 m off, after several bounces and a slide.
TEST(ExactWorldSlope, pointOnTheWayChangesNothing) {
  const Vec3 aside(4, 1, -6);
  const World whole = thrown({{.time = 0, .gravity = kDown}, {.time = 1, .gravity = aside}});
  const World split = thrown({{.time = 0, .gravity = kDown},
                              {.time = 0.37, .gravity = kDown + 0.37 * (aside - kDown)},
                              {.time = 1, .gravity = aside}});
  EXPECT_LT(apart(whole, split, 1.5), 1e-4);
}

// Of second order in the length of the steps, which are the means of what they stand for.
TEST(ExactWorldSlope, manyStepsComeNear) {
  const Vec3 aside(4, 1, -6);
  const World sloped = thrown({{.time = 0, .gravity = kDown}, {.time = 0.5, .gravity = aside}});
  double before = 0;
  for (const int steps : {100, 400}) {
    World stepped = sloped;
    stepped.gravityPath = GravityPath::kSteps;
    stepped.gravityChanges.clear();
    for (int k = 0; k < steps; ++k) {
      const Vec3 mean = kDown + (k + 0.5) / steps * (aside - kDown);
      if (k == 0) {
        stepped.gravity = mean;
      } else {
        stepped.gravityChanges.push_back({.time = 0.5 * k / steps, .gravity = mean});
      }
    }
    const double off = apart(sloped, stepped, 0.5);
    EXPECT_LT(off, 1e-3);
    if (before > 0) {
      EXPECT_LT(off, 0.2 * before);
    }
    before = off;
  }
}

// A bar on a hinge, from .5 rad, under gravity that grows. 1e-8 m off.
TEST(ExactWorldSlope, jointedBodiesFeelIt) {
  World world = sloping({{.time = 0, .gravity = kDown}, {.time = 2, .gravity = 3 * kDown}});
  world.bodies = {test::bar("bar", 0.5)};
  test::join(world, Joint::Kind::kHinge, 0, {}, Vec3::Zero(), Vec3::UnitY());
  // J φ'' = −m g(t) l sin φ by many small steps of the classical Runge–Kutta method.
  const Vec3 pivot = Vec3::Zero();
  const double arm = (world.bodies[0].initial.pose.position - pivot).norm();
  const double gyration =
      1 / (world.bodies[0].mass.inverseInertiaBody.y() * world.bodies[0].mass.mass) + arm * arm;
  double angle = 0.5;
  double rate = 0;
  constexpr int kSteps = 20000;
  const double h = 1.0 / kSteps;
  const auto bend = [&](double time, double at) {
    return -kWeight * (1 + time) * arm / gyration * std::sin(at);
  };
  for (int k = 0; k < kSteps; ++k) {
    const double t = k * h;
    const double a1 = bend(t, angle);
    const double a2 = bend(t + h / 2, angle + h / 2 * rate);
    const double a3 = bend(t + h / 2, angle + h / 2 * (rate + h / 2 * a1));
    const double a4 = bend(t + h, angle + h * (rate + h / 2 * a2));
    angle += h * (rate + h / 6 * (a1 + a2 + a3));
    rate += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
  const BodyState state = runFor(world, 1).last(world, 0, 1);
  EXPECT_NEAR(state.pose.position.z(), -arm * std::cos(angle), 1e-6);
  EXPECT_NEAR(angularVelocity(world.bodies[0].mass, state).y(), rate, 1e-5);
}

// A crowd on a table that is tilted slides as each of its boxes would alone.
TEST(ExactWorldSlope, crowdsFeelIt) {
  World world = onFloor(Vec3::Constant(0.1), 0.2,
                        {{.time = 0, .gravity = kDown}, {.time = 2, .gravity = Vec3(6, 0, -kWeight)}});
  const Body one = world.bodies[0];
  world.bodies.clear();
  for (int k = 0; k < 40; ++k) {
    world.bodies.push_back(one);
    world.bodies.back().name = "box" + std::to_string(k);
    world.bodies.back().initial.pose.position = Vec3(0.2 * (k % 8), 0.2 * (k / 8), 0.1);
  }
  const Recorded run = runInCrowd(world, 1.2);
  const double s = 1.2 - 0.2 * kWeight / 3;
  for (std::size_t body = 0; body < world.bodies.size(); ++body) {
    const Vec3 moved = run.last(world, body, 1.2).pose.position - world.bodies[body].initial.pose.position;
    EXPECT_NEAR(moved.x(), 0.5 * s * s * s, 1.2e-3) << body;
    EXPECT_NEAR(moved.z(), 0, 2e-5) << body;
  }
}

}  // namespace
}  // namespace careen
