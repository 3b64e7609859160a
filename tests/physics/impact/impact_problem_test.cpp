#include "physics/impact/impact_problem.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "core/error.h"
#include "physics/solver/contact_problem.h"

namespace careen {
namespace {

Vec3 anyVector(std::mt19937_64& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  return {number(random), number(random), number(random)};
}

// The rows times the velocities are the relative velocity of the two points, in the contact's directions.
TEST(ImpactProblem, rowsGiveRelativeVelocities) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 200; ++round) {
    std::array<MassProperties, 2> masses;
    std::array<BodyState, 2> states;
    std::array<Vec3, 2> spins;
    for (std::size_t i = 0; i < 2; ++i) {
      masses[i] = solidBox({0.2, 0.3, 0.4}, 2.0 + static_cast<double>(i));
      const Quat turned = Quat(0.3, anyVector(random)[0], anyVector(random)[1], 0.7).normalized();
      states[i].pose.worldFromBody = turned.toRotationMatrix();
      states[i].velocity = anyVector(random);
      spins[i] = anyVector(random);
      states[i].angularMomentum = angularMomentum(masses[i], states[i].pose.worldFromBody, spins[i]);
    }
    const std::array<ImpactBody, 2> bodies{{{&masses[0], &states[0]}, {&masses[1], &states[1]}}};
    const std::array<ImpactContact, 1> contacts{{{.a = 1,
                                                  .b = 0,
                                                  .armA = anyVector(random),
                                                  .armB = anyVector(random),
                                                  .normal = anyVector(random).normalized(),
                                                  .material = {.restitution = 0, .friction = 0.5}}}};
    const ContactProblem problem = impactProblemOf(bodies, contacts);
    ASSERT_EQ(problem.contacts.size(), 1U);
    const ContactProblem::Contact& contact = problem.contacts[0];
    const Vec3 relative = states[1].velocity + spins[1].cross(contacts[0].armA) -
                          (states[0].velocity + spins[0].cross(contacts[0].armB));
    std::array<double, 3> speeds{};
    const std::array<int, 2> sides{contact.a, contact.b};
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t k = 0; k < 2 * ContactProblem::kAxes; ++k) {
        const auto body = static_cast<std::size_t>(sides[k / ContactProblem::kAxes]);
        speeds[row] +=
            contact.rows[row][k] * problem.free[body * ContactProblem::kAxes + k % ContactProblem::kAxes];
      }
    }
    EXPECT_NEAR(speeds[0], contacts[0].normal.dot(relative), 1e-14);
    EXPECT_NEAR(speeds[0] * speeds[0] + speeds[1] * speeds[1] + speeds[2] * speeds[2], relative.squaredNorm(),
                1e-13);
    EXPECT_EQ(contact.friction, 0.5);
  }
}

TEST(ImpactProblem, onlyBodiesThatCanMoveTakePart) {
  const MassProperties held = immovable();
  const MassProperties light = solidBox({0.1, 0.1, 0.1}, 1);
  BodyState atRest;
  BodyState moving;
  moving.velocity = Vec3(0, 0, -1);
  const std::array<ImpactBody, 2> bodies{{{&held, &atRest}, {&light, &moving}}};
  const ImpactContact contact{
      .a = 1, .b = 0, .armA = Vec3(0, 0, -0.1), .armB = Vec3(0, 0, 0.1), .material = {}};
  const ContactProblem problem = impactProblemOf(bodies, std::array{contact});
  EXPECT_EQ(problem.free.size(), ContactProblem::kAxes);
  EXPECT_EQ(problem.contacts[0].a, 0);
  EXPECT_EQ(problem.contacts[0].b, ContactProblem::kNobody);

  const std::array<ImpactBody, 2> both{{{&held, &atRest}, {&held, &moving}}};
  EXPECT_THROW(impactProblemOf(both, std::array{contact}), NumericalError);
}

}  // namespace
}  // namespace careen
