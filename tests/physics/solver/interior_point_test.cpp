#include "physics/solver/interior_point.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <vector>

#include "physics/solver/contact_scene.h"

namespace careen {
namespace {

// The analytic centre of all distributions of the weight is the even one.
TEST(InteriorPoint, endsAtTheCentre) {
  for (const double friction : {0.0, 0.5}) {
    const ContactScene scene = cubeStack(3, 2, 0.5, friction);
    CoupledContacts contacts;
    contacts.set(scene.problem);
    InteriorPoint method;
    method.start(contacts, {});
    int iterations = 0;
    double gap = method.gap();
    while (method.gap() > 1e-17 && iterations < 40) {
      ASSERT_TRUE(method.advance(contacts)) << friction << " " << iterations << " " << method.gap();
      EXPECT_LT(method.gap(), gap);
      gap = method.gap();
      ++iterations;
    }
    EXPECT_LE(iterations, 15);
    std::vector<ContactProblem::Triple> impulses;
    contacts.exportImpulses(method.impulses(), impulses);
    for (std::size_t c = 0; c < impulses.size(); ++c) {
      const double above = 3.0 - static_cast<double>(c / 4);
      EXPECT_NEAR(impulses[c][0], above * 2 * 0.5 / 4, 1e-8) << friction;
    }
  }
}

// Spins of 1 kg m² each about x, y and z: one row stops its own, one would need more than it has, and one has
// its impulse given.
TEST(InteriorPoint, staysInIntervals) {
  ContactScene scene;
  scene.add(6, {0.5, 0.5, 0.5}, {0, 0, 0}, {0, 0, 0}, {0.5, 3, -2});
  const std::array<std::array<double, 2>, 3> intervals{{{-1, 1}, {-2, 1}, {0.25, 0.25}}};
  for (std::size_t k = 0; k < 3; ++k) {
    ContactProblem::Contact row{.a = 0,
                                .admissible = ContactProblem::Admissible::kInterval,
                                .least = intervals[k][0],
                                .most = intervals[k][1]};
    row.rows[0][3 + k] = 1;
    scene.problem.contacts.push_back(row);
  }
  CoupledContacts contacts;
  contacts.set(scene.problem);
  InteriorPoint method;
  method.start(contacts, {});
  int iterations = 0;
  for (; method.gap() > 1e-17 && iterations < 40; ++iterations) {
    ASSERT_TRUE(method.advance(contacts)) << iterations;
  }
  EXPECT_LE(iterations, 15);
  std::vector<ContactProblem::Triple> impulses;
  contacts.exportImpulses(method.impulses(), impulses);
  EXPECT_NEAR(impulses[0][0], -0.5, 1e-8);
  EXPECT_NEAR(impulses[1][0], -2, 1e-8);
  EXPECT_EQ(impulses[2][0], 0.25);
}

// A cube that lands while it slides, v_x = 1 − μ v_z. With |u_t| as a number the problem is convex: with the
// right one its answer is that of Coulomb's law; with none, it lifts off by μ times what slips.
TEST(InteriorPoint, ofAConvexProblemFindsTheAnswerThatBelongsToTheSlip) {
  constexpr double kFriction = 0.25;
  ContactScene scene;
  const int cube = scene.add(2, {0.5, 0.5, 0.5}, {0, 0, 0.5}, {1, 0, -0.5});
  scene.touchFlat(cube, kNobody, 0, 0, 0.5, 0.5, 0, kFriction);
  CoupledContacts contacts;
  contacts.set(scene.problem);
  const auto velocitiesWith = [&](double slip) {
    InteriorPoint method;
    method.start(contacts, {}, std::vector<double>(4, slip));
    for (int k = 0; k < 40 && method.gap() > 1e-15; ++k) {
      EXPECT_TRUE(method.advance(contacts)) << k;
    }
    std::vector<double> q(6);
    contacts.velocities(method.impulses(), q);
    return q;
  };
  const double right = 1 - kFriction * 0.5;
  const std::vector<double> slides = velocitiesWith(right);
  EXPECT_NEAR(slides[0], right, 1e-7);
  EXPECT_NEAR(slides[2], 0, 1e-7);
  const std::vector<double> lifts = velocitiesWith(0);
  EXPECT_NEAR(lifts[2], kFriction * lifts[0], 1e-7);
  EXPECT_GT(lifts[2], 0.1);
}

}  // namespace
}  // namespace careen
