#include "physics/solver/contact_rows.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/article_equations.h"

namespace careen {
namespace {

// Rows times velocities are the point's velocity along each direction: v + ω × arm, written out.
TEST(ContactRows, tellHowFastAPointMoves) {
  const Mat3 worldFromPrincipal = axisAngle(Vec3(0.6, 0, 0.8), 1.1) * axisAngle(Vec3::UnitY(), -0.4);
  const std::array<Vec3, 3> directions{Vec3(0, 0.6, 0.8), Vec3(1, 0, 0), Vec3(0, 0.8, -0.6)};
  const Vec3 arm(0.3, -0.2, 0.7);
  const Vec3 velocity(1, -2, 0.5);
  const Vec3 omega(-0.4, 3, 1.5);
  const Vec3 omegaPrincipal = worldFromPrincipal.transpose() * omega;
  for (const std::size_t side : {0U, 1U}) {
    ContactProblem::Contact contact;
    const double sign = side == 0 ? 1 : -1;
    setSide(contact, side, pointSide(directions, arm, sign), worldFromPrincipal);
    const Vec3 point(velocity[0] + (omega[1] * arm[2] - omega[2] * arm[1]),
                     velocity[1] + (omega[2] * arm[0] - omega[0] * arm[2]),
                     velocity[2] + (omega[0] * arm[1] - omega[1] * arm[0]));
    for (std::size_t row = 0; row < 3; ++row) {
      double speed = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto axis = static_cast<Eigen::Index>(k);
        speed += contact.rows[row][6 * side + k] * velocity[axis] +
                 contact.rows[row][6 * side + 3 + k] * omegaPrincipal[axis];
        EXPECT_EQ(contact.rows[row][6 * (1 - side) + k], 0);
        EXPECT_EQ(contact.rows[row][6 * (1 - side) + 3 + k], 0);
      }
      double wanted = 0;
      for (Eigen::Index k = 0; k < 3; ++k) {
        wanted += directions[row][k] * point[k];
      }
      EXPECT_NEAR(speed, sign * wanted, 1e-14);
    }
  }
}

// A row need not act at a point: of a hinge only turning counts.
TEST(ContactRows, mayTurnAlone) {
  ContactProblem::Contact contact;
  const Mat3 quarter = axisAngle(Vec3::UnitZ(), std::acos(-1.0) / 2);
  setSide(contact, 0,
          {.linear = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()},
           .turning = {Vec3::UnitX(), Vec3::UnitY(), Vec3::Zero()}},
          quarter);
  const ContactProblem::Row first = contact.rows[0];  // the world's x is the body's −y
  EXPECT_EQ(first[0], 0);
  EXPECT_NEAR(first[4], -1, 1e-15);
  EXPECT_NEAR(contact.rows[1][3], 1, 1e-15);
  EXPECT_EQ(contact.rows[2], ContactProblem::Row{});
}

}  // namespace
}  // namespace careen
