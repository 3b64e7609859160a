#include "physics/solver/contact_newton.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "physics/solver/contact_scene.h"

namespace careen {
namespace {

using Triple = ContactProblem::Triple;

struct Iterate {
  explicit Iterate(const ContactScene& scene)
      : impulses(scene.problem.contacts.size()), q(scene.problem.free.size()) {
    contacts.set(scene.problem);
  }
  CoupledContacts contacts;
  std::vector<Triple> impulses;
  std::vector<double> q;
  ContactNewton method;
};

/// A cube that slides, of which all contacts are closed.
ContactScene sliding() {
  ContactScene scene = cubeStack(1, 2, 1, 0.1);
  scene.problem.free[0] = 3;
  scene.problem.free[1] = -2;
  return scene;
}

TEST(ContactNewton, stackAtRestTakesTenSteps) {
  Iterate at(cubeStack(5, 1, 1, 0.5));
  EXPECT_LE(at.method.approach(at.contacts, at.impulses, at.q, {.epsilon = 0x1p-7, .enough = 1e-15}), 1e-15);
  EXPECT_LE(at.method.factorisations(), 10);
  for (const double speed : at.q) {
    EXPECT_NEAR(speed, 0, 1e-15);
  }
}

TEST(ContactNewton, bothWaysLeadToTheSolution) {
  for (const bool proximal : {false, true}) {
    Iterate at(sliding());
    const ContactNewton::Options options{.rho = 1, .epsilon = 0x1p-10, .steps = 60, .enough = 1e-13};
    const double residual = proximal ? at.method.approach(at.contacts, at.impulses, at.q, options)
                                     : at.method.improve(at.contacts, at.impulses, at.q, options);
    EXPECT_LE(residual, 1e-13) << proximal;
    EXPECT_LE(ContactNewton::residual(at.contacts, at.impulses, at.q), 1e-13);
    EXPECT_GT(at.q[0], 2);
  }
}

// Taken as closed and sticking, what stands is found in one step, and two for its rounding errors;
// however heavy the top of the stack.
TEST(ContactNewton, stickingStartFindsWhatStandsAtOnce) {
  for (const double heavy : {1.0, 1e6}) {
    ContactScene scene = cubeStack(10, 1, 1, 0.5);
    for (std::size_t k = 0; k < 6; ++k) {
      scene.problem.inverseMass[54 + k] /= heavy;
    }
    Iterate at(scene);
    const ContactNewton::Options options{.epsilon = 0x1p-40, .enough = 1e-9, .sticking = true};
    EXPECT_LE(at.method.improve(at.contacts, at.impulses, at.q, options), 1e-9);
    EXPECT_LE(at.method.factorisations(), 3) << heavy;
  }
}

TEST(ContactNewton, stopsWhereTheCallerIsContentButNotAtGhosts) {
  Iterate at(sliding());
  at.method.approach(at.contacts, at.impulses, at.q, {.epsilon = 0x1p-7, .enough = 1e-15, .good = 1e-2});
  const double residual = ContactNewton::residual(at.contacts, at.impulses, at.q);
  EXPECT_LE(residual, 1e-2);
  EXPECT_GT(residual, 1e-9);
  EXPECT_TRUE(ContactNewton::isGood(at.contacts, at.impulses, 1e-4, 1e-2));
  EXPECT_FALSE(ContactNewton::isGood(at.contacts, at.impulses, 1e-1, 1e-2));
  for (Triple& impulse : at.impulses) {
    impulse[0] *= 1e-6;
  }
  EXPECT_FALSE(ContactNewton::isGood(at.contacts, at.impulses, 1e-4, 1e-2));
}

TEST(ContactNewton, givenImpulsesOutsideTheirConesAreBroughtIn) {
  for (const bool proximal : {false, true}) {
    Iterate at(sliding());
    for (Triple& impulse : at.impulses) {
      impulse = {0.25, 1, 0};
    }
    const ContactNewton::Options none{.steps = 0};
    const double residual = proximal ? at.method.approach(at.contacts, at.impulses, at.q, none)
                                     : at.method.improve(at.contacts, at.impulses, at.q, none);
    for (const Triple& impulse : at.impulses) {
      EXPECT_NEAR(impulse[1], 0.1 * 0.25, 1e-15);
    }
    EXPECT_EQ(residual, ContactNewton::residual(at.contacts, at.impulses, at.q));
  }
}

// Redundant contacts keep the uneven distribution that they start from, but for what has to change.
TEST(ContactNewton, keepsTheDistribution) {
  Iterate at(cubeStack(1, 1, 1, 0.5));
  std::vector<Triple> listed{{0.5, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0.5, 0, 0}};
  listed[1][0] = 1e-3;
  listed[2][0] = 1e-3;
  at.contacts.importImpulses(listed, at.impulses);
  at.method.improve(at.contacts, at.impulses, at.q, {.enough = 1e-15});
  at.contacts.exportImpulses(at.impulses, listed);
  EXPECT_NEAR(listed[0][0], 0.4995, 1e-6);
  EXPECT_NEAR(listed[1][0], 0.0005, 1e-6);
}

}  // namespace
}  // namespace careen
