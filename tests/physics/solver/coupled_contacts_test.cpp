#include "physics/solver/coupled_contacts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "physics/solver/contact_scene.h"

namespace careen {
namespace {

using Triple = ContactProblem::Triple;

TEST(CoupledContacts, impulsesChangeVelocities) {
  const ContactScene scene = cubeStack(3, 2, 1, 0.5);
  CoupledContacts contacts;
  contacts.set(scene.problem);
  EXPECT_EQ(contacts.scale(), 1);
  std::vector<Triple> listed(12);
  listed[8] = {4, 0, 0};  // top cube on the middle one
  std::vector<Triple> impulses(12);
  contacts.importImpulses(listed, impulses);
  std::vector<double> q(18);
  contacts.velocities(impulses, q);
  std::vector<double> velocities;
  contacts.exportVelocities(q, velocities);
  EXPECT_EQ(velocities[2], -1);
  EXPECT_EQ(velocities[8], -1 - 4 / 2.0);
  EXPECT_EQ(velocities[14], -1 + 4 / 2.0);
  std::vector<Triple> back;
  contacts.exportImpulses(impulses, back);
  EXPECT_EQ(back, listed);
}

TEST(CoupledContacts, heaviestIsOfTwoBodiesInContact) {
  ContactScene scene;
  const ContactScene::Vector half{0.5, 0.5, 0.5};
  const int low = scene.add(2, half, {0, 0, 0.5}, {0, 0, -1});
  const int high = scene.add(50, half, {0, 0, 1.5}, {0, 0, -1});
  scene.add(1e6, half, {5, 0, 0.5}, {0, 0, -1});  // beside them
  scene.touchFlat(low, kNobody, 0, 0, 0.5, 0.5, 0, 0.5);
  scene.touchFlat(low, high, 0, 0, 0.5, 0.5, 1, 0.5);
  CoupledContacts contacts;
  contacts.set(scene.problem);
  EXPECT_NEAR(contacts.heaviest(), 25, 1e-14);
}

// q + dq = q₀ + M⁻¹Jᵀ(given − stiffness J dq).
TEST(CoupledContacts, stepSolvesItsEquation) {
  const ContactScene scene = brickWall(3, 2, 1, 0.5);
  CoupledContacts contacts;
  contacts.set(scene.problem);
  const std::size_t count = contacts.contacts().size();
  std::vector<ContactAnswer> answers(count);
  for (std::size_t c = 0; c < count; ++c) {
    answers[c].given = {1, 0.125 * static_cast<double>(c % 3), -0.25};
    answers[c].stiffness = {5, 0, 0, 1, 3, 0, -1, 0, 2};
  }
  answers[1] = {};
  ASSERT_TRUE(contacts.factorise(answers));
  std::vector<double> q(scene.problem.free.size(), 0.1);
  std::vector<double> dq(q.size());
  contacts.step(answers, q, dq);
  std::vector<Triple> impulses(count);
  for (std::size_t c = 0; c < count; ++c) {
    impulses[c] = contacts.answerTo(c, answers[c], dq);
  }
  EXPECT_EQ(impulses[1], (Triple{}));
  std::vector<double> after(q.size());
  contacts.velocities(impulses, after);
  for (std::size_t k = 0; k < q.size(); ++k) {
    EXPECT_NEAR(q[k] + dq[k], after[k], 1e-13);
  }
}

}  // namespace
}  // namespace careen
