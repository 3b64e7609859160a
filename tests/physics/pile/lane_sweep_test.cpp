#include "physics/pile/lane_sweep.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "core/system/team.h"

namespace careen {
namespace {

using Kind = LaneSweep::Kind;

// Cubes of 1 m and 2 kg, whose I⁻¹ is 3/(kg m²), in a tower or side by side; rows under their centres.
struct Tower {
  explicit Tower(int count, double change = 1e-9, bool sideBySide = false) : bodies(at(count) + 1) {
    for (int k = 0; k < count; ++k) {
      bodies[at(k)] = {.inverseMass = 0.5, .xx = 3, .yy = 3, .zz = 3, .radius = 1, .change = change};
      const bool onFloor = k == 0 || sideBySide;
      list.begin(
          {.a = k, .b = onFloor ? count : k - 1, .friction = 0.5, .apart = Vec3(0, 0, onFloor ? 0 : 1)});
      list.add({.arm = Vec3(0, 0, -0.5)});
    }
    rows.fill(list, bodies);
    sweep.begin(rows.groups());
    moving.resize(rows.groups().bodyCount());
    for (int k = 0; k < count; ++k) {
      moving[at(k)].velocity = Vec3(3, 0, -1);
    }
  }
  void wake(int block) { sweep.wake(rows.groups().placeOf(block)); }
  std::int64_t run(Kind kind, int sweeps) { return sweep.run(kind, sweeps, rows, moving); }
  double normalImpulse(int row) const { return rows.of(row).normalImpulse[rows.laneOf(row)]; }

  std::vector<SolverBody> bodies;
  RowList list;
  LaneRows rows{std::make_shared<Team>(1), widestRegisters()};
  LaneSweep sweep;
  std::vector<Moving> moving;
};

TEST(LaneSweep, solvesNothingThatIsNotOnTheList) {
  Tower tower(2);
  EXPECT_EQ(tower.run(Kind::kFriction, 10), 0);
  EXPECT_EQ(tower.moving[0].velocity, Vec3(3, 0, -1));
}

// 2 kg at 1 m/s: 2 N s would stop it. Relaxed by 1.4: 2.8, then 2.8 − 2.8 · 0.4 = 1.68, then on towards 2.
TEST(LaneSweep, relaxesNormalImpulses) {
  Tower tower(1);
  tower.wake(0);
  EXPECT_EQ(tower.run(Kind::kFrictionless, 1), 1);
  EXPECT_DOUBLE_EQ(tower.normalImpulse(0), 2.8);
  EXPECT_NEAR(tower.moving[0].velocity.z(), 0.4, 1e-15);
  EXPECT_EQ(tower.run(Kind::kFrictionless, 1), 1);  // it put itself on the list
  EXPECT_NEAR(tower.normalImpulse(0), 1.68, 1e-15);
  tower.run(Kind::kFrictionless, 100);
  EXPECT_NEAR(tower.normalImpulse(0), 2, 1e-8);
  EXPECT_EQ(tower.moving[0].velocity.x(), 3);
  EXPECT_EQ(tower.moving[0].pushed, 1);
}

// k₁₁ = ½ + 3/4: 2.4 N s would stop the point's 3 m/s; friction gives 0.5 · 2.8 = 1.4 N s. v −= 1.4/2, and
// ω = 3 · (0, ½ · 1.4, 0).
TEST(LaneSweep, slidesAtTheFrictionLimit) {
  Tower tower(1);
  tower.wake(0);
  tower.run(Kind::kFriction, 1);
  const LaneRow& row = tower.rows.of(0);
  EXPECT_NEAR(row.tangential1[tower.rows.laneOf(0)], -1.4, 1e-15);
  EXPECT_EQ(row.tangential2[tower.rows.laneOf(0)], 0);
  EXPECT_NEAR(tower.moving[0].velocity.x(), 2.3, 1e-15);
  EXPECT_NEAR(tower.moving[0].omega.y(), 2.1, 1e-15);
}

// At 1 m/s to the side, 1/1.25 N s stop it within the disc.
TEST(LaneSweep, sticksWithinTheDisc) {
  Tower tower(1);
  tower.moving[0].velocity = Vec3(1, 0, -1);
  tower.wake(0);
  tower.run(Kind::kFriction, 1);
  EXPECT_NEAR(tower.rows.of(0).tangential1[tower.rows.laneOf(0)], -0.8, 1e-15);
  const Moving& after = tower.moving[0];
  EXPECT_NEAR(after.velocity.x() - 0.5 * after.omega.y(), 0, 1e-15);
}

// By 1.4 m/s in the first sweep, 0.56 in the second, 0.22 in the third.
TEST(LaneSweep, goesOnWhileBodiesChange) {
  for (const auto& [change, solves] : {std::pair{1.5, 1}, {1.0, 2}, {0.5, 3}}) {
    Tower tower(1, change);
    tower.wake(0);
    EXPECT_EQ(tower.run(Kind::kFrictionless, 10), solves) << change;
  }
}

// The upper one of two falls on the lower one, whose block comes first: that is solved in the next sweep.
TEST(LaneSweep, wakesTheBlocksOfBodiesThatChange) {
  Tower tower(2);
  tower.moving[0].velocity = Vec3::Zero();
  tower.wake(1);
  EXPECT_EQ(tower.run(Kind::kFrictionless, 1), 1);
  EXPECT_EQ(tower.normalImpulse(0), 0);
  EXPECT_EQ(tower.run(Kind::kFrictionless, 1), 2);
  EXPECT_GT(tower.normalImpulse(0), 0);
}

TEST(LaneSweep, leavesThoseBesideOneOnTheListAsTheyAre) {
  Tower cubes(3, 1e-9, true);
  ASSERT_EQ(cubes.rows.groups().groups().size(), 1U);
  cubes.wake(1);
  EXPECT_EQ(cubes.run(Kind::kFriction, 1), 1);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(cubes.normalImpulse(k) > 0, k == 1);
    EXPECT_EQ(cubes.moving[at(k)].pushed, k == 1);
    EXPECT_EQ(cubes.moving[at(k)].velocity == Vec3(3, 0, -1), k != 1);
  }
}

// A bound of 0.5 m: relaxed, 1.4 times that. The velocities stay.
TEST(LaneSweep, shiftsWithoutVelocity) {
  Tower tower(1);
  tower.rows.beginShifts(0, tower.moving);
  tower.rows.shiftOf(0).bound[tower.rows.laneOf(0)] = 0.5;
  std::vector<Moving> shifts(tower.moving.size());
  tower.wake(0);
  EXPECT_EQ(tower.sweep.run(Kind::kShift, 10, tower.rows, shifts, 1), 1);  // 0.7 m is less than 1 m
  EXPECT_DOUBLE_EQ(shifts[0].velocity.z(), 0.7);
  EXPECT_EQ(shifts[0].pushed, 1);
  EXPECT_EQ(tower.moving[0].velocity, Vec3(3, 0, -1));
  EXPECT_EQ(tower.normalImpulse(0), 0);
}

}  // namespace
}  // namespace careen
