#include "physics/solver/contact_sweeps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "physics/solver/contact_newton.h"
#include "physics/solver/contact_scene.h"

namespace careen {
namespace {

// A cube that slides, of which all contacts are closed.
TEST(ContactSweeps, converge) {
  ContactScene scene = cubeStack(1, 2, 1, 0.1);
  scene.problem.free[0] = 3;
  scene.problem.free[1] = -2;
  CoupledContacts contacts;
  contacts.set(scene.problem);
  const std::vector<ContactProblem::Triple> none(4);
  std::vector<double> q(6);
  ContactSweeps sweeps;
  sweeps.start(contacts, none);
  double before = ContactNewton::residual(contacts, sweeps.impulses(), q);
  EXPECT_GT(before, 0.1);
  for (int k = 0; k < 4; ++k) {
    EXPECT_TRUE(sweeps.sweep(contacts, 20));
    const double now = ContactNewton::residual(contacts, sweeps.impulses(), q);
    EXPECT_LE(now, std::max(before / 4, 1e-15));
    before = now;
  }
}

// Painlevé: a push lets the end of this rod sink faster still.
TEST(ContactSweeps, tellThatTheyDiverge) {
  ContactScene scene;
  scene.add(1, {1, 0.01, 0.01}, {-0.5, 0, 0.5}, {0, 0, -1});
  scene.touch(0, ContactProblem::kNobody, {0, 0, 0}, 2, 1, 8);
  scene.problem.contacts[0].slips = true;
  scene.problem.contacts[0].slip = {1, 0};
  CoupledContacts contacts;
  contacts.set(scene.problem);
  const std::vector<ContactProblem::Triple> none(1);
  ContactSweeps sweeps;
  sweeps.start(contacts, none);
  EXPECT_FALSE(sweeps.sweep(contacts, 1000));
}

}  // namespace
}  // namespace careen
