#include "physics/contact/impulses_without_approach.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "support/touching_bodies.h"

namespace careen {
namespace {

// One step of a cube on the floor, its corners closed, whatever its velocity.
struct Stepped {
  explicit Stepped(const Vec3& velocity, double h)
      : world(cubeAbove(0.1, velocity)),
        bodies(touching(world)),
        equations(world, bodies, 1e-6),
        found(equations.group(), 0.25e-6) {
    step.length = h;
    step.start = equations.group().state();
    found.find(step.start, 0);
    law = found.obeying(h, {});
    EXPECT_TRUE(equations.advance(step.start, h, law, step.end));
  }
  std::optional<JammedMoment> moment() { return jammedMomentOf(step, found, law, equations); }

  World world;
  std::vector<TouchingBody> bodies;
  ImplicitStep equations;
  FoundContacts found;
  GroupStep step;
  std::vector<ClosedContact> law;
};

TEST(ImpulsesWithoutApproach, forcesAreNone) {
  EXPECT_FALSE(Stepped(Vec3::Zero(), 1e-3).moment());
  EXPECT_FALSE(Stepped(Vec3(1, 0, 0), 1e-3).moment());
}

// 1 kg that must stop from 2 m/s takes 2 N s however short the step is: a 64th of it, or what moves nothing,
// √(0.0625 µm / 10 m/s²) = 79 µs.
TEST(ImpulsesWithoutApproach, thatDoNotShrinkWithTheStepActInAMoment) {
  for (const double h : {1e-3, 1e-2}) {
    Stepped stepped(Vec3(1, 0, -2), h);
    const std::optional<JammedMoment> moment = stepped.moment();
    ASSERT_TRUE(moment.has_value());
    const double length = std::min(h / 64, std::sqrt(0.0625e-6 / 10));
    EXPECT_NEAR(moment->step.length, length, 1e-12);
    EXPECT_NEAR(moment->part, length / h, 1e-9);
    EXPECT_NEAR(moment->change, 2, 1e-6);
    double impulse = 0;
    for (const ClosedContact& contact : moment->law) {
      impulse += contact.push * moment->step.length;
    }
    EXPECT_NEAR(impulse, 2, 2e-3);                             // and the weight's in that time
    EXPECT_NEAR(moment->step.start[0].velocity.z(), 0, 1e-5);  // from the start on
    EXPECT_NEAR(moment->step.start[0].velocity.x(), 1, 1e-9);
    EXPECT_EQ(moment->step.end[0].velocity, moment->step.start[0].velocity);
    EXPECT_NEAR(moment->step.end[0].position.x(), length, 1e-9);
    EXPECT_TRUE(moment->step.middle.empty());
  }
}

}  // namespace
}  // namespace careen
