#include "physics/pile/solver_body.h"

#include <gtest/gtest.h>

#include <vector>

#pragma GCC diagnostic ignored "-Wpsabi"  // as lanes.h says: a precompiled header forgets it

namespace careen {
namespace {

Body brick() {  // of 12 kg, 1 × 2 × 3 m: I = (13, 10, 5) kg m²
  Body body;
  body.halfExtents = Vec3(0.5, 1, 1.5);
  body.mass = solidBox(body.halfExtents, 12);
  return body;
}

// Turned by 90° about z, its x axis points along y: the moments about x and y change places.
TEST(SolverBody, turnsAsItsInertiaInTheWorldSays) {
  Body body = brick();
  body.initial.pose.worldFromBody << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  body.initial.pose.position = Vec3(1, 2, 3);
  const SolverBody solver = solverBody(pileBody(body, body.initial), 0.25);
  EXPECT_TRUE(solver.moves());
  EXPECT_DOUBLE_EQ(solver.inverseMass, 1.0 / 12);
  const Vec3 turned = solver.turned(Vec3(1, 1, 1));
  EXPECT_NEAR(turned.x(), 1.0 / 10, 1e-15);
  EXPECT_NEAR(turned.y(), 1.0 / 13, 1e-15);
  EXPECT_NEAR(turned.z(), 1.0 / 5, 1e-15);
  EXPECT_EQ(solver.place, Vec3(1, 2, 3));
  EXPECT_EQ(solver.change, 0.25);
}

TEST(SolverBody, ofOneThatSleepsDoesNotMove) {
  const Body body = brick();
  PileBody sleeper = pileBody(body, body.initial);
  sleeper.asleep = true;
  const SolverBody solver = solverBody(sleeper, 0.25);
  EXPECT_FALSE(solver.moves());
  EXPECT_EQ(solver.turned(Vec3(1, 1, 1)), Vec3(0, 0, 0));
}

TEST(Moving, isReadAndWrittenBodyByBody) {
  std::vector<Moving> all(6);
  for (int k = 0; k < 6; ++k) {
    const double x = 10 * k;
    all[at(k)] = {.velocity = Vec3(x, x + 1, x + 2),
                  .unqueuedChange = x + 3,
                  .omega = Vec3(x + 4, x + 5, x + 6),
                  .pushed = x + 7};
  }
  const LaneBodies bodies = {4, 0, 5, 2};
  MovingLanes lanes = movingOf(all, bodies);
  for (int lane = 0; lane < kLanes; ++lane) {
    const double x = 10 * bodies[at(lane)];
    EXPECT_EQ(lanes.v.x[lane], x);
    EXPECT_EQ(lanes.v.z[lane], x + 2);
    EXPECT_EQ(lanes.unqueuedChange[lane], x + 3);
    EXPECT_EQ(lanes.w.y[lane], x + 5);
    EXPECT_EQ(lanes.pushed[lane], x + 7);
  }
  lanes.w.z[1] = -1;  // of body 0
  std::vector<Moving> others(6);
  setMoving(others, bodies, lanes);
  EXPECT_EQ(others[0].velocity, all[0].velocity);
  EXPECT_EQ(others[0].omega, Vec3(4, 5, -1));
  EXPECT_EQ(others[5].omega, all[5].omega);
  EXPECT_EQ(others[2].pushed, all[2].pushed);
  EXPECT_EQ(others[1].velocity, Vec3(0, 0, 0));  // is none of them
}

}  // namespace
}  // namespace careen
