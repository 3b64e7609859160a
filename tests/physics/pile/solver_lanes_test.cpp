#include "physics/pile/solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/system/team.h"
#include "physics/pile/body.h"
#include "physics/pile/solver.h"
#include "support/pile_scenes.h"

namespace careen {
namespace {

using test::normalSpeed;

// A chain of boxes whose neighbours touch at up to four points, thrown together: rows of any length in blocks
// that share bodies.
std::vector<double> solved(Registers registers) {
  constexpr int kBodies = 40;
  test::Pourer pourer(3);
  std::vector<PileBody> bodies;
  for (int k = 0; k < kBodies; ++k) {
    Body body;
    body.halfExtents = pourer.vector(0.1, 0.4);
    body.mass = k % 9 == 0 ? immovable() : solidBox(body.halfExtents, pourer.between(1, 50));
    body.initial.pose.position = Vec3(k, 0, 0);
    body.initial.pose.worldFromBody = pourer.attitude().toRotationMatrix();
    bodies.push_back(pileBody(body, body.initial));
  }
  PileSolver solver(std::make_shared<Team>(1), registers);
  solver.begin(kBodies);
  for (int k = 0; k < kBodies; ++k) {
    solver.setBody(k, bodies[static_cast<std::size_t>(k)], 1e-9);
    if (!bodies[static_cast<std::size_t>(k)].still()) {
      solver.velocity(k) = pourer.vector(-2, 2);
      solver.omega(k) = pourer.vector(-2, 2);
    }
  }
  for (int k = 0; k + 1 < kBodies; ++k) {
    const Vec3 normal = pourer.vector(-1, 1).normalized();
    const Vec3 tangent = normal.unitOrthogonal();
    const ContactFrame frame{.normal = normal, .tangent1 = tangent, .tangent2 = normal.cross(tangent)};
    solver.beginBlock(k, k + 1, k % 3 == 0 ? 0 : 0.5, frame, Vec3(-1, 0, 0));
    for (int row = 0; row <= k % 4; ++row) {
      solver.add({.arm = pourer.vector(0, 1), .bound = -0.01 * row, .normalImpulse = row == 1 ? 0.1 : 0});
    }
  }
  solver.link();
  solver.warmStart();
  solver.wakeAll();
  solver.solve(30);
  solver.beginShifts(0);
  for (int row = 0; row < static_cast<int>(solver.rowCount()); ++row) {
    solver.addToShiftBound(row, row % 5 == 0 ? 1e-3 : 0);
    solver.wakeRow(row);
  }
  solver.shift(20, 1e-9);
  std::vector<double> found;
  for (int k = 0; k < kBodies; ++k) {
    for (const Vec3& v : {solver.velocity(k), solver.omega(k), solver.displacement(k), solver.turn(k)}) {
      found.insert(found.end(), {v.x(), v.y(), v.z()});
    }
  }
  for (int row = 0; row < static_cast<int>(solver.rowCount()); ++row) {
    found.insert(found.end(), {solver.normalImpulse(row), solver.tangential1(row), solver.tangential2(row)});
  }
  return found;
}

TEST(PileSolver, widthOfRegistersChangesNoBit) {
  if (widestRegisters() == Registers::kNarrow) {
    GTEST_SKIP() << "this machine has no wide registers";
  }
  const std::vector<double> wide = solved(Registers::kWide);
  EXPECT_EQ(solved(Registers::kNarrow), wide);
  for (const double x : wide) {
    ASSERT_TRUE(std::isfinite(x));
  }
}

// What Gauss–Seidel converges to: no row closes faster than its bound, and impulses lie in their cones.
TEST(PileSolver, solveTheirRows) {
  constexpr int kBodies = 4;
  PileSolver solver;
  solver.begin(kBodies);
  std::vector<PileBody> bodies;
  for (int k = 0; k < kBodies; ++k) {
    Body body;
    body.halfExtents = Vec3(0.5, 0.5, 0.5);
    body.mass = k == 0 ? immovable() : solidBox(body.halfExtents, 1 + k);
    body.initial.pose.position = Vec3(0, 0, k);
    bodies.push_back(pileBody(body, body.initial));
  }
  for (int k = 0; k < kBodies; ++k) {
    solver.setBody(k, bodies[static_cast<std::size_t>(k)], 1e-12);
    if (k > 0) {
      solver.velocity(k) = Vec3(0.1 * k, 0, -1);
    }
  }
  for (int k = 0; k + 1 < kBodies; ++k) {  // a tower: the upper one is a, the lower b
    solver.beginBlock(k + 1, k, 0.3, {}, Vec3(0, 0, 1));
    for (const Vec3& corner :
         {Vec3(-0.5, -0.5, -0.5), Vec3(0.5, -0.5, -0.5), Vec3(-0.5, 0.5, -0.5), Vec3(0.5, 0.5, -0.5)}) {
      solver.add({.arm = corner});
    }
  }
  solver.link();
  solver.warmStart();
  solver.wakeAll();
  EXPECT_GT(solver.solve(2000), 0);
  double pushed = 0;
  double slowest = 0;
  for (int row = 0; row < static_cast<int>(solver.rowCount()); ++row) {
    EXPECT_GT(test::normalSpeed(solver, row), -2e-5) << row;  // measured -4e-6
    EXPECT_LE(std::hypot(solver.tangential1(row), solver.tangential2(row)),
              0.3 * solver.normalImpulse(row) + 1e-12);
    slowest = std::min(slowest, test::normalSpeed(solver, row));
    pushed += row < 4 ? solver.normalImpulse(row) : 0;
  }
  RecordProperty("slowest", std::to_string(slowest));
  RecordProperty("pushed", std::to_string(pushed));
  EXPECT_NEAR(pushed, 2 + 3 + 4, 2e-4);  // the floor takes the whole momentum
}

}  // namespace
}  // namespace careen
