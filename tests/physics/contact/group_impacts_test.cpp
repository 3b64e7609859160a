#include "physics/contact/group_impacts.h"

#include <gtest/gtest.h>

#include <vector>

#include "support/touching_bodies.h"

namespace careen {
namespace {

// The bodies of a world at the start of a step, and what strikes there.
struct Meeting {
  explicit Meeting(World of)
      : world(std::move(of)),
        bodies(touching(world)),
        equations(world, bodies, 1e-6),
        found(equations.group(), 0.25e-6),
        impacts(equations),
        state(equations.group().state()) {
    found.find(state, 0);
  }
  World world;
  std::vector<TouchingBody> bodies;
  ImplicitStep equations;
  FoundContacts found;
  GroupImpacts impacts;
  GroupState state;
};

double sumOfImpulses(const GroupImpacts& impacts) {
  double sum = 0;
  for (const GroupImpact& impact : impacts.list()) {
    sum += impact.share.impulse;
  }
  return sum;
}

// 1 kg at 2 m/s: (1 + e) 2 N s.
TEST(GroupImpacts, giveBackTheRestitutionOfWhatLandsFlat) {
  for (const double restitution : {0.0, 0.5, 1.0}) {
    Meeting land(cubeAbove(0.1, Vec3(0, 0, -2), 0, restitution));
    land.impacts.resolve(land.state, land.found, 10);
    EXPECT_NEAR(land.state[0].velocity.z(), 2 * restitution, 1e-9);
    ASSERT_EQ(land.impacts.list().size(), 4U);
    EXPECT_NEAR(sumOfImpulses(land.impacts), 2 * (1 + restitution), 1e-9);
    EXPECT_NEAR(land.impacts.list()[0].share.approach, 2, 1e-12);
    EXPECT_NEAR(land.impacts.list()[0].cause, 2, 1e-12);
    EXPECT_NEAR(land.found.rate(0), 2 * restitution, 1e-9);  // followed
  }
}

// v²/2g of a sixteenth of a closed gap: at 10 m/s², 0.56 mm/s.
TEST(GroupImpacts, hopsTooLowToFollowAreNone) {
  for (const double speed : {0.5e-3, 0.6e-3}) {
    Meeting land(cubeAbove(0.1, Vec3(0, 0, -speed), 0, 1));
    land.impacts.resolve(land.state, land.found, 10);
    EXPECT_NEAR(land.state[0].velocity.z(), speed < 0.55e-3 ? 0 : speed, 1e-9) << speed;
  }
}

// Three cubes in a row, the first strikes the second; a fourth is apart from them, and on the floor.
TEST(GroupImpacts, reachWhatIsJoinedAndNothingElse) {
  World world = floorWith(0, 0);
  for (const double x : {0.0, 0.2, 0.4, 1.0}) {
    world.bodies.push_back(box("cube", Vec3(0.1, 0.1, 0.1), 1, Vec3(x, 0, x < 1 ? 1 : 0.1)));
    world.bodies.back().material.restitution = 0;
  }
  world.bodies[0].initial.velocity.x() = 3;
  Meeting push(world);
  push.impacts.resolve(push.state, push.found, 10);
  for (std::size_t i = 0; i < 3; ++i) {  // of one speed, as nothing springs back
    EXPECT_NEAR(push.state[i].velocity.x(), 1, 1e-9) << i;
  }
  EXPECT_EQ(push.state[3].velocity, Vec3::Zero());
  for (const GroupImpact& impact : push.impacts.list()) {
    EXPECT_TRUE(push.bodies[static_cast<std::size_t>(impact.contact.b)].isBox());
  }
}

// A push of 5 N in 0.1 s gives 0.5 N s, and 1 kg 0.5 m/s.
TEST(GroupImpacts, areKeptIfTheyChangeMoreThanAForceDoes) {
  Meeting rest(cubeAbove(0.1));
  std::vector<ClosedContact> law = rest.found.obeying(0.1, {});
  ASSERT_EQ(law.size(), 4U);
  law[1].push = 5;
  law[1].friction = Vec3(3, 0, 0);
  rest.impacts.addWithoutApproach(rest.found, law, 0.1, 0.7);
  ASSERT_EQ(rest.impacts.list().size(), 1U);
  EXPECT_NEAR(rest.impacts.list()[0].share.impulse, 0.5, 1e-15);
  EXPECT_NEAR(rest.impacts.list()[0].share.tangential, 0.3, 1e-15);
  EXPECT_EQ(rest.impacts.list()[0].share.approach, 0);
  rest.impacts.keepLarger(0.49);
  EXPECT_EQ(rest.impacts.list().size(), 1U);
  rest.impacts.keepLarger(0.51);
  EXPECT_TRUE(rest.impacts.list().empty());
}

}  // namespace
}  // namespace careen
