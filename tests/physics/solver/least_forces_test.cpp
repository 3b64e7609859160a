#include "physics/solver/least_forces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "physics/geometry/contact_frame.h"
#include "physics/solver/contact_rows.h"

namespace careen {
namespace {

constexpr double kPull = 10;  // [m/s²]

// A cube of side 1 that is to stand still under such a weight [N/kg], and under a mass on it.
void addCube(ContactProblem& problem, double mass, const Vec3& pull) {
  for (int k = 0; k < 3; ++k) {
    problem.inverseMass.push_back(1 / mass);
    problem.free.push_back(pull[k]);
  }
  for (int k = 0; k < 3; ++k) {
    problem.inverseMass.push_back(6 / mass);
    problem.free.push_back(0);
  }
}

ContactProblem::Contact& touch(ContactProblem& problem, int a, int b, const Vec3& normal, const Vec3& armA,
                               double friction) {
  ContactProblem::Contact contact{.a = a, .b = b, .friction = friction};
  const ContactFrame frame = frameOf(normal);
  setSide(contact, 0, pointSide(frame.axes(), armA, 1), Mat3::Identity());
  if (b != ContactProblem::kNobody) {
    setSide(contact, 1, pointSide(frame.axes(), armA + Vec3::UnitZ(), -1), Mat3::Identity());
  }
  problem.contacts.push_back(contact);
  return problem.contacts.back();
}

void standOn(ContactProblem& problem, int a, int b, double friction) {
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      touch(problem, a, b, Vec3::UnitZ(), Vec3(x, y, -0.5), friction);
    }
  }
}

double most(const std::vector<double>& numbers) {
  double largest = 0;
  for (const double number : numbers) {
    largest = std::max(largest, std::fabs(number));
  }
  return largest;
}

// However heavy the top of a stack is, its corners share what is above them.
TEST(LeastForces, ofAStackAreQuartersOfWhatIsAbove) {
  ContactProblem problem;
  constexpr int kBoxes = 20;
  for (int k = 0; k < kBoxes; ++k) {
    addCube(problem, k + 1 == kBoxes ? 1000 : 2, Vec3(0, 0, -kPull));
    standOn(problem, k, k - 1, 0.5);
  }
  const LeastForces found = leastForces(problem);
  for (std::size_t c = 0; c < found.forces.size(); ++c) {
    const double above = 1000 + 2.0 * (kBoxes - 1 - static_cast<double>(c / 4));
    EXPECT_NEAR(found.forces[c][0], above * kPull / 4, 1e-8);  // measured: 2e-9
    EXPECT_NEAR(std::hypot(found.forces[c][1], found.forces[c][2]), 0, 1e-8);
  }
  EXPECT_LT(most(found.left), 1e-9);  // measured: 6e-11
}

// On a slope of 20° the pressure is at m g (cos ± sin)/4 each: the lower edge bears more, as friction at the
// bottom turns the cube. With all of least squares friction is shared as far as the upper corners' cones go.
TEST(LeastForces, onASlopeAreInTheConesAndBalanceWeightAndTorque) {
  const double slope = 20 * std::numbers::pi / 180;
  ContactProblem problem;
  addCube(problem, 2, kPull * Vec3(std::sin(slope), 0, -std::cos(slope)));
  standOn(problem, 0, ContactProblem::kNobody, 0.5);
  const LeastForces found = leastForces(problem);
  const double across = 2 * kPull * std::cos(slope);
  const double along = 2 * kPull * std::sin(slope);
  // The torque of friction along·½ is that of the edges' difference·½.
  const double upper = (across - along) / 4;
  const double lower = (across + along) / 4;
  for (std::size_t c = 0; c < 4; ++c) {
    EXPECT_NEAR(found.forces[c][0], c < 2 ? upper : lower, 1e-12);
  }
  // A quarter each is 1.71, more than the upper cones' 1.49 (upper 2.99): they give all, the lower the rest.
  for (std::size_t c = 0; c < 4; ++c) {
    EXPECT_NEAR(std::hypot(found.forces[c][1], found.forces[c][2]),
                c < 2 ? 0.5 * upper : 0.5 * along - 0.5 * upper, 1e-12);
  }
  EXPECT_LT(most(found.left), 1e-13);
}

// Of 45° with a friction of ½ the force is nearest to the weight in the cone: what is left is across it.
TEST(LeastForces, thatDoNotExistLeaveTheLeast) {
  ContactProblem problem;
  addCube(problem, 2, Vec3(kPull, 0, -kPull));
  // One contact below the middle, without an arm, so that nothing turns.
  touch(problem, 0, ContactProblem::kNobody, Vec3::UnitZ(), Vec3::Zero(), 0.5);
  const LeastForces found = leastForces(problem);
  // 20 N each way; the cone's edge (−½, 1)/√1.25 gets 30/√1.25 of it.
  // Measured: 3e-7, as what is left is known to a thousandth of a proximal step.
  EXPECT_NEAR(found.forces[0][0], 24, 1e-6);
  EXPECT_NEAR(std::hypot(found.forces[0][1], found.forces[0][2]), 12, 1e-6);
  EXPECT_NEAR(found.left[0], 4, 1e-6);  // 10 − 12/2
  EXPECT_NEAR(found.left[2], 2, 1e-6);  // −10 + 24/2
}

TEST(LeastForces, slipAndAreHeldAndGripAsContactsSay) {
  using Set = ContactProblem::Admissible;
  ContactProblem problem;
  addCube(problem, 1, Vec3(0, 0, -kPull));
  ContactProblem::Contact& contact =
      touch(problem, 0, ContactProblem::kNobody, Vec3::UnitZ(), Vec3::Zero(), 0.5);
  contact.admissible = Set::kLine;
  contact.slip = {1, 0};
  const ContactFrame frame = frameOf(Vec3::UnitZ());
  for (int k = 0; k < 3; ++k) {
    problem.free[static_cast<std::size_t>(k)] += 5 * frame.tangent1[k];  // braked with ½ · 10
  }
  LeastForces found = leastForces(problem);
  EXPECT_NEAR(found.forces[0][0], 10, 1e-12);
  EXPECT_NEAR(found.forces[0][1], -5, 1e-12);
  EXPECT_LT(most(found.left), 1e-12);
  // It hangs: what holds pulls.
  problem.contacts[0].admissible = Set::kSpace;
  problem.free[2] = kPull;
  found = leastForces(problem);
  EXPECT_NEAR(found.forces[0][0], -10, 1e-12);
  // A grip gives no more than it has.
  problem.contacts[0].admissible = Set::kInterval;
  problem.contacts[0].rows[1] = problem.contacts[0].rows[2] = {};
  problem.contacts[0].least = -3;
  problem.contacts[0].most = 3;
  found = leastForces(problem);
  EXPECT_NEAR(found.forces[0][0], -3, 1e-12);
  EXPECT_NEAR(found.left[2], 7, 1e-12);
}

// Optimal is what no admissible change makes less: f·(g − f) ≥ 0 for all g that give the same; here g are
// other forces in the cones with the same sum and torque, f plus what is in the kernel.
TEST(LeastForces, haveTheLeastSumOfSquares) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  int compared = 0;
  for (int trial = 0; trial < 200; ++trial) {
    ContactProblem problem;
    addCube(problem, 1, Vec3(3 * normal(random), 3 * normal(random), -kPull));
    standOn(problem, 0, ContactProblem::kNobody, 0.6);
    const LeastForces found = leastForces(problem);
    double squares = 0;
    for (const ContactProblem::Triple& force : found.forces) {
      EXPECT_LE(std::hypot(force[1], force[2]), 0.6 * force[0] + 1e-12);
      squares += force[0] * force[0] + force[1] * force[1] + force[2] * force[2];
    }
    if (most(found.left) > 1e-9) {
      continue;
    }
    for (int other = 0; other < 20; ++other) {
      // Pairs along the line between two corners, and normals at opposite corners, change no sum.
      std::vector<ContactProblem::Triple> forces = found.forces;
      const double size = std::exp(3 * normal(random) - 3);
      for (const int c : {0, 3}) {
        forces[static_cast<std::size_t>(c)][0] += size;
      }
      for (const int c : {1, 2}) {
        forces[static_cast<std::size_t>(c)][0] -= size;
      }
      bool isIn = true;
      double sum = 0;
      for (const ContactProblem::Triple& force : forces) {
        isIn = isIn && std::hypot(force[1], force[2]) <= 0.6 * force[0];
        sum += force[0] * force[0] + force[1] * force[1] + force[2] * force[2];
      }
      if (isIn) {
        EXPECT_GE(sum, squares * (1 - 1e-12));
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 300);
}

TEST(LeastForces, ofNothingAreNone) {
  ContactProblem problem;
  addCube(problem, 1, Vec3::Zero());
  EXPECT_TRUE(leastForces(problem).forces.empty());
  standOn(problem, 0, ContactProblem::kNobody, 0.5);
  for (const ContactProblem::Triple& force : leastForces(problem).forces) {
    EXPECT_EQ(force, (ContactProblem::Triple{0, 0, 0}));
  }
}

}  // namespace
}  // namespace careen
