#include "physics/solver/displacement_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "core/system/team.h"
#include "physics/world/body.h"
#include "support/pile_scenes.h"

namespace careen {
namespace {

constexpr int kNobody = DisplacementSolver::kNobody;

using Bodies = std::vector<DisplacementSolver::Body>;

DisplacementSolver::Body boxOf(const Vec3& halfExtents, const Mat3& axes, double mass) {
  const MassProperties box = solidBox(halfExtents, mass);
  return {.inverseMass = box.inverseMass,
          .inverseInertia = axes * box.inverseInertiaBody.asDiagonal() * axes.transpose()};
}

DisplacementSolver::Body cubeOf(double mass) { return boxOf(Vec3::Constant(0.5), Mat3::Identity(), mass); }

void begin(DisplacementSolver& solver, const Bodies& bodies) {
  solver.begin(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    solver.setBody(static_cast<int>(k), bodies[k]);
  }
}

DisplacementSolver::Row between(int right, int left, double bound) {
  return {.a = right,
          .b = left,
          .armA = right == kNobody ? Vec3::Zero() : Vec3(-0.5, 0, 0),
          .armB = left == kNobody ? Vec3::Zero() : Vec3(0.5, 0, 0),
          .normal = Vec3::UnitX(),
          .bound = bound};
}

double along(const DisplacementSolver& solver, int body) {
  return solver.moves(body) ? solver.displacement(body).x() : 0;
}

// A millimetre in the middle of a long chain: both halves move by half of it. A sweep of Gauss–Seidel carries
// it one link further.
TEST(DisplacementSolver, carriesThroughALongChain) {
  constexpr int kCount = 20;
  const Bodies cubes(kCount, cubeOf(1));
  DisplacementSolver solver;
  begin(solver, cubes);
  for (int k = 1; k < kCount; ++k) {
    solver.add(between(k, k - 1, k == kCount / 2 ? 1e-3 : 0));
  }
  const int steps = solver.solve(1e-6, 300);
  EXPECT_LT(steps, 300);  // measured 46
  double sum = 0;
  for (int k = 0; k < kCount; ++k) {
    EXPECT_NEAR(along(solver, k), k < kCount / 2 ? -0.5e-3 : 0.5e-3, 0.05e-3) << k;
    sum += along(solver, k);
  }
  EXPECT_LT(std::abs(sum), 1e-15);
  RecordProperty("steps", steps);
}

// A wall of cubes, side by side and one on the other: 500 blocks of rows, which several threads share.
std::vector<Vec3> opened(int threads) {
  constexpr int kAcross = 16;
  constexpr int kCount = kAcross * kAcross;
  Bodies cubes;
  for (int k = 0; k < kCount; ++k) {
    cubes.push_back(cubeOf(1 + k % 3));
  }
  DisplacementSolver solver(std::make_shared<Team>(threads));
  begin(solver, cubes);
  for (int k = 0; k < kCount; ++k) {
    for (const auto& [other, there, axis] :
         {std::tuple(k - 1, k % kAcross > 0, 0), std::tuple(k - kAcross, k >= kAcross, 2)}) {
      const Vec3 normal = Vec3::Unit(axis);
      for (int corner = 0; there && corner < 6; ++corner) {
        const Vec3 arm = (corner % 2 - 0.5) * Vec3::UnitY() + (0.2 * corner - 0.5) * Vec3::Unit(2 - axis);
        solver.add({.a = k,
                    .b = other,
                    .armA = arm - 0.5 * normal,
                    .armB = arm + 0.5 * normal,
                    .normal = normal,
                    .bound = (k * 7 + corner) % 11 == 0 ? 1e-3 : 0});
      }
    }
  }
  EXPECT_LT(solver.solve(1e-7, 1000), 1000) << threads;
  std::vector<Vec3> moves;
  for (int k = 0; k < kCount; ++k) {
    moves.insert(moves.end(), {solver.displacement(k), solver.turn(k)});
  }
  return moves;
}

TEST(DisplacementSolver, numberOfThreadsChangesNoBit) {
  const std::vector<Vec3> alone = opened(1);
  for (const int threads : {2, 3, 8}) {
    EXPECT_EQ(opened(threads), alone) << threads;
  }
}

// Ten cubes in a space that is a millimetre too short.
TEST(DisplacementSolver, sharesWhatCannotBe) {
  constexpr int kCount = 10;
  const Bodies cubes(kCount, cubeOf(1));
  DisplacementSolver solver;
  begin(solver, cubes);
  solver.add(between(0, kNobody, 0));
  for (int k = 1; k < kCount; ++k) {
    solver.add(between(k, k - 1, k == 3 ? 1e-3 : 0));
  }
  solver.add(between(kNobody, kCount - 1, 0));
  EXPECT_LT(solver.solve(1e-6, 300), 300);
  double most = 0;
  for (int k = 0; k <= kCount; ++k) {
    const double opened = (k < kCount ? along(solver, k) : 0) - (k > 0 ? along(solver, k - 1) : 0);
    most = std::max(most, (k == 3 ? 1e-3 : 0) - opened);
  }
  EXPECT_LT(most, 1.5e-3 / (kCount + 1));  // measured 1.0e-4; no less than 0.91e-4 is possible
}

// By trying all sets of rows that may push: of few rows.
Eigen::VectorXd enumerated(const Bodies& boxes, const std::vector<DisplacementSolver::Row>& rows) {
  const auto count = static_cast<Eigen::Index>(rows.size());
  const auto size = static_cast<Eigen::Index>(6 * boxes.size());
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(count, size);
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd bounds(count);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const auto from = static_cast<Eigen::Index>(6 * i);
    inverse.block<3, 3>(from, from) = boxes[i].inverseMass * Mat3::Identity();
    inverse.block<3, 3>(from + 3, from + 3) = boxes[i].inverseInertia;
  }
  for (Eigen::Index k = 0; k < count; ++k) {
    const DisplacementSolver::Row& row = rows[static_cast<std::size_t>(k)];
    const auto fill = [&](int body, const Vec3& arm, double sign) {
      if (body != kNobody) {
        jacobian.block<1, 3>(k, 6 * body) = sign * row.normal.transpose();
        jacobian.block<1, 3>(k, 6 * body + 3) = sign * arm.cross(row.normal).transpose();
      }
    };
    fill(row.a, row.armA, 1);
    fill(row.b, row.armB, -1);
    bounds[k] = row.bound;
  }
  Eigen::MatrixXd matrix = jacobian * inverse * jacobian.transpose();
  matrix.diagonal() *= 1 + DisplacementSolver::kCompliance;
  for (unsigned set = 0; set < (1U << rows.size()); ++set) {
    std::vector<Eigen::Index> chosen;
    for (Eigen::Index k = 0; k < count; ++k) {
      if (((set >> k) & 1U) != 0) {
        chosen.push_back(k);
      }
    }
    Eigen::VectorXd impulses = Eigen::VectorXd::Zero(count);
    if (!chosen.empty()) {
      const Eigen::MatrixXd square = matrix(chosen, chosen);
      const Eigen::VectorXd wanted = bounds(chosen);
      const Eigen::VectorXd found = square.ldlt().solve(wanted);
      impulses(chosen) = found;
    }
    if (impulses.minCoeff() >= 0 && (matrix * impulses - bounds).minCoeff() > -1e-12) {
      return inverse * jacobian.transpose() * impulses;
    }
  }
  return {};
}

TEST(DisplacementSolver, findsWhatAnEnumerationOfSetsFinds) {
  test::Pourer pourer(11);
  double worst = 0;
  int compared = 0;
  for (int problem = 0; problem < 1000; ++problem) {
    Bodies boxes;
    for (int k = 0; k < 3; ++k) {
      const Vec3 halfExtents = pourer.vector(0.2, 0.6);
      const Mat3 axes = pourer.attitude().toRotationMatrix();
      boxes.push_back(boxOf(halfExtents, axes, pourer.between(1, 5)));
    }
    std::vector<DisplacementSolver::Row> rows;
    for (int k = 0; k < 7; ++k) {
      DisplacementSolver::Row row = {.a = k % 3, .b = k < 3 ? kNobody : (k + 1) % 3};
      row.armA = pourer.vector(-0.5, 0.5);
      row.armB = pourer.vector(-0.5, 0.5);
      row.normal = (pourer.vector(-1, 1) + Vec3(0, 0, 0.1)).normalized();
      row.bound = pourer.between(-1e-3, 1e-3);
      rows.push_back(row);
    }
    const Eigen::VectorXd expected = enumerated(boxes, rows);
    DisplacementSolver solver;
    begin(solver, boxes);
    for (const DisplacementSolver::Row& row : rows) {
      solver.add(row);
    }
    solver.solve(0, 1000);
    ASSERT_EQ(expected.size(), 18) << problem;
    const double largest = expected.cwiseAbs().maxCoeff();
    for (int k = 0; k < 3 && largest > 0; ++k) {
      const Vec3 shift = solver.moves(k) ? solver.displacement(k) : Vec3(Vec3::Zero());
      const Vec3 turn = solver.moves(k) ? solver.turn(k) : Vec3(Vec3::Zero());
      const double off = std::max((shift - expected.segment<3>(6 * k)).cwiseAbs().maxCoeff(),
                                  (turn - expected.segment<3>(6 * k + 3)).cwiseAbs().maxCoeff());
      worst = std::max(worst, off / largest);
      ++compared;
    }
  }
  EXPECT_GT(compared, 2000);
  RecordProperty("worst", std::to_string(worst));
  EXPECT_LT(worst, 0.15);  // measured 0.113: of the largest, as the last tenths are not looked for
}

}  // namespace
}  // namespace careen
