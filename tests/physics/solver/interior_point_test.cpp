#include "physics/solver/interior_point.h"

#include <gtest/gtest.h>

#include <cstddef>

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

}  // namespace
}  // namespace careen
