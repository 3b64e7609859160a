#include "physics/exact/changing_world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/jointed.h"

namespace careen {
namespace {

World hinged() {
  World world;
  world.bodies = {box("box", Vec3::Constant(0.1), 1, Vec3::Zero())};
  test::join(world, Joint::Kind::kHinge, 0, {}, Vec3::Zero());
  world.control = Control{.period = 0.25, .motors = {{.joint = 0, .target = {.offset = 1}, .stiffness = 8}}};
  return world;
}

BodyState turned(const World& world, double angle) {
  BodyState state = world.bodies[0].initial;
  state.pose.worldFromBody = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
  return state;
}

TEST(ChangingWorld, changesItsGravityInOrder) {
  World world;
  world.gravity = Vec3(0, 0, -1);
  world.gravityChanges = {{.time = 1, .gravity = Vec3(1, 0, 0)}, {.time = 3, .gravity = Vec3(0, 2, 0)}};
  ChangingWorld changing(world);
  EXPECT_EQ(changing.nextJump(), 1);
  EXPECT_EQ(changing.world().gravity, Vec3(0, 0, -1));
  changing.jump();
  EXPECT_EQ(changing.world().gravity, Vec3(1, 0, 0));
  EXPECT_EQ(changing.nextJump(), 3);
  changing.jump();
  EXPECT_EQ(changing.world().gravity, Vec3(0, 2, 0));
  EXPECT_TRUE(std::isinf(changing.nextJump()));
}

TEST(ChangingWorld, slopesFromOnePointToTheNext) {
  World world;
  world.gravity = Vec3(0, 0, -1);
  world.gravityPath = GravityPath::kLinear;
  world.gravityChanges = {{.time = 1, .gravity = Vec3(1, 0, -1)}, {.time = 3, .gravity = Vec3(1, 0, -5)}};
  ChangingWorld changing(world);
  EXPECT_EQ(gravitySlope(changing.world()), Vec3(1, 0, 0));
  EXPECT_EQ(gravityNow(changing.world(), 0.5), Vec3(0.5, 0, -1));
  changing.jump();
  EXPECT_EQ(gravitySlope(changing.world()), Vec3(0, 0, -2));
  EXPECT_EQ(gravityNow(changing.world(), 2), Vec3(1, 0, -3));
  changing.jump();
  EXPECT_FALSE(isGravitySloping(changing.world()));
  EXPECT_EQ(gravityNow(changing.world(), 9), Vec3(1, 0, -5));
}

TEST(ChangingWorld, samplesAtMultiplesOfItsPeriod) {
  const World world = hinged();
  ChangingWorld changing(world);
  Recorded run;
  Notes notes(run);
  for (const double time : {0.0, 0.25, 0.5}) {
    EXPECT_EQ(changing.next(), time);
    EXPECT_EQ(changing.nextOf(0), time);
    changing.change(std::vector<BodyState>{turned(world, time)}, notes);
    EXPECT_NEAR(changing.world().joints[0].effort, 8 * (1 - time), 1e-14);
  }
  ASSERT_EQ(run.driven.size(), 3U);
  EXPECT_EQ(run.driven[1].time, 0.25);
  EXPECT_EQ(world.joints[0].effort, 0);
}

// From sample to sample it turns by less than half a turn: 3 of 2 rad each are 6 rad.
TEST(ChangingWorld, countsTurns) {
  const World world = hinged();
  ChangingWorld changing(world);
  Recorded run;
  Notes notes(run);
  for (int k = 0; k <= 3; ++k) {
    changing.change(std::vector<BodyState>{turned(world, 2.0 * k)}, notes);
  }
  EXPECT_NEAR(changing.world().joints[0].effort, 8 * (1 - 6), 1e-13);
}

TEST(ChangingWorld, takesTheLoadOffWhatLetsGo) {
  World world = hinged();
  world.joints[0].until = 0.3;
  world.joints[0].stiffness = 2;
  ChangingWorld changing(world);
  Recorded run;
  Notes notes(run);
  const std::vector<BodyState> states{turned(world, 0.5)};
  changing.change(states, notes);
  changing.change(states, notes);
  EXPECT_EQ(changing.next(), 0.3);
  EXPECT_EQ(changing.nextOf(0), 0.3);
  EXPECT_EQ(changing.world().joints[0].stiffness, 2);
  changing.change(states, notes);
  EXPECT_FALSE(changing.world().joints[0].isLoaded());
  EXPECT_TRUE(std::isinf(changing.nextOf(0)));
  EXPECT_EQ(run.driven.back().effort, 0);
  EXPECT_EQ(run.driven.back().time, 0.3);
}

TEST(ChangingWorld, asksItsCallback) {
  World world = hinged();
  world.control->motors.clear();
  world.control->callback = [](double time, std::span<const BodyState>, std::span<const JointSample> joints,
                               std::span<double> efforts) { efforts[0] = time + joints[0].coordinate; };
  ChangingWorld changing(world);
  Recorded run;
  Notes notes(run);
  changing.change(std::vector<BodyState>{turned(world, 0)}, notes);
  changing.change(std::vector<BodyState>{turned(world, 0.5)}, notes);
  EXPECT_NEAR(changing.world().joints[0].effort, 0.75, 1e-15);
}

}  // namespace
}  // namespace careen
