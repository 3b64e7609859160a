#include "physics/pile/lane_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "core/system/team.h"

namespace careen {
namespace {

// A cube of 1 m and 2 kg, whose I⁻¹ is 3/(kg m²), on a floor: one row under a lower edge's middle, and one
// under its centre.
class CubeOnFloor : public testing::Test {
 protected:
  CubeOnFloor() {
    bodies[0] = {.inverseMass = 0.5, .xx = 3, .yy = 3, .zz = 3, .radius = std::sqrt(0.75), .change = 0.1};
    list.begin({.a = 0, .b = 1, .friction = 0.5});
    list.add({.arm = Vec3(0.5, 0, -0.5), .bound = -0.25, .normalImpulse = 2, .tangential1 = 0.5});
    list.add({.arm = Vec3(0, 0, -0.5)});
    rows.fill(list, bodies);
    moving.resize(rows.groups().bodyCount());
    moving[0].velocity = Vec3(0, 1, -1);
  }

  std::vector<SolverBody> bodies{2};
  RowList list;
  LaneRows rows{std::make_shared<Team>(1), widestRegisters()};
  std::vector<Moving> moving;
};

// With r = (½, 0, −½): r × n = (0, −½, 0), r × x = (0, −½, 0), r × y = (½, 0, ½). So n M⁻¹ nᵀ = ½ + 3/4, as
// k₁₁, k₂₂ = ½ + 3/2, k₁₂ = 0, and an impulse along n turns as one along x does: by 3/4.
TEST_F(CubeOnFloor, hasTheEffectiveMassesOfItsPoints) {
  const int lane = rows.laneOf(0);
  const LaneRow& edge = rows.of(0);
  EXPECT_DOUBLE_EQ(edge.relaxedMass[lane], 1.4 / 1.25);
  EXPECT_DOUBLE_EQ(edge.stop11[lane], 1 / 1.25);
  EXPECT_DOUBLE_EQ(edge.stop22[lane], 1 / 2.0);
  EXPECT_EQ(edge.stop12[lane], 0);
  EXPECT_DOUBLE_EQ(edge.slide[lane], 1 / 2.0);
  EXPECT_DOUBLE_EQ(edge.normalToTangent1[lane], 0.75);
  EXPECT_EQ(edge.normalToTangent2[lane], 0);
  const LaneRow& centre = rows.of(1);
  EXPECT_DOUBLE_EQ(centre.relaxedMass[lane], 1.4 / 0.5);
  EXPECT_EQ(centre.normalToTangent1[lane], 0);
  for (int other = 0; other < kLanes; ++other) {
    EXPECT_TRUE(other == lane || edge.relaxedMass[other] + edge.slide[other] + edge.stop11[other] == 0);
  }
}

// u = (0, 1, −1) at both: 2 N s at −1 m/s, where −0.25 m/s is allowed; 0.5 N s across it does no work.
TEST_F(CubeOnFloor, impulsesWorkOnTheMotionBeyondTheBound) {
  EXPECT_DOUBLE_EQ(rows.workOfImpulses(moving), -1.5);
  rows.clearImpulses();
  EXPECT_EQ(rows.workOfImpulses(moving), 0);
}

// By J = (0.5, 0, 2) N s: v += J/2, ω += 3 r × J = 3 (0, −½ · ½ − ½ · 2, 0).
TEST_F(CubeOnFloor, isPushedByItsInitialImpulses) {
  rows.push(moving);
  EXPECT_EQ(moving[0].velocity, Vec3(0.25, 1, 0));
  EXPECT_EQ(moving[0].omega, Vec3(0, -3.75, 0));
  EXPECT_EQ(moving[0].pushed, 1);
  EXPECT_EQ(moving[1].pushed, 0);  // the floor
}

TEST_F(CubeOnFloor, lacksWhatItsShiftsDoNotDo) {
  rows.beginShifts(0.5, moving);  // at −1 m/s
  EXPECT_EQ(rows.shiftOf(0).bound[rows.laneOf(0)], 0.5);
  std::vector<Moving> shifted(moving.size());
  shifted[0].velocity = Vec3(0, 0, 0.375);
  EXPECT_EQ(rows.mostLacking(shifted), 0.125);
  shifted[0].omega = Vec3(0, 0.5, 0);  // the edge goes down by a half of that
  EXPECT_EQ(rows.mostLacking(shifted), 0.375);
}

// Primal: the row under the centre at −1 m/s; dual: none, 0.5 N s is less than 0.5 · 2; power at the edge:
// |2 · (−1 + 0.25) + (1 · 1 + 0.5 · 0)| = 0.5 W s; all by S = 4 m/s and Λ = √4.25 N s.
TEST_F(CubeOnFloor, hasTheResidualsOfItsRows) {
  const ContactResiduals residuals = rows.residuals(4, moving);
  EXPECT_DOUBLE_EQ(residuals.primal, 1.0 / 4);
  EXPECT_EQ(residuals.dual, 0);
  EXPECT_DOUBLE_EQ(residuals.complementarity, 0.5 / std::sqrt(4.25) / 4);
}

}  // namespace
}  // namespace careen
