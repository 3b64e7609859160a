#include "physics/exact/controlled_world.h"

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

TEST(ControlledWorld, samplesAtMultiplesOfItsPeriod) {
  const World world = hinged();
  ControlledWorld controlled(world);
  Recorded run;
  Notes notes(run);
  for (const double time : {0.0, 0.25, 0.5}) {
    EXPECT_EQ(controlled.next(), time);
    EXPECT_EQ(controlled.nextOf(0), time);
    controlled.change(std::vector<BodyState>{turned(world, time)}, notes);
    EXPECT_NEAR(controlled.world().joints[0].effort, 8 * (1 - time), 1e-14);
  }
  ASSERT_EQ(run.driven.size(), 3U);
  EXPECT_EQ(run.driven[1].time, 0.25);
  EXPECT_EQ(world.joints[0].effort, 0);
}

// From sample to sample it turns by less than half a turn: 3 of 2 rad each are 6 rad.
TEST(ControlledWorld, countsTurns) {
  const World world = hinged();
  ControlledWorld controlled(world);
  Recorded run;
  Notes notes(run);
  for (int k = 0; k <= 3; ++k) {
    controlled.change(std::vector<BodyState>{turned(world, 2.0 * k)}, notes);
  }
  EXPECT_NEAR(controlled.world().joints[0].effort, 8 * (1 - 6), 1e-13);
}

TEST(ControlledWorld, takesTheLoadOffWhatLetsGo) {
  World world = hinged();
  world.joints[0].until = 0.3;
  world.joints[0].stiffness = 2;
  ControlledWorld controlled(world);
  Recorded run;
  Notes notes(run);
  const std::vector<BodyState> states{turned(world, 0.5)};
  controlled.change(states, notes);
  controlled.change(states, notes);
  EXPECT_EQ(controlled.next(), 0.3);
  EXPECT_EQ(controlled.nextOf(0), 0.3);
  EXPECT_EQ(controlled.world().joints[0].stiffness, 2);
  controlled.change(states, notes);
  EXPECT_FALSE(controlled.world().joints[0].isLoaded());
  EXPECT_TRUE(std::isinf(controlled.nextOf(0)));
  EXPECT_EQ(run.driven.back().effort, 0);
  EXPECT_EQ(run.driven.back().time, 0.3);
}

TEST(ControlledWorld, asksItsCallback) {
  World world = hinged();
  world.control->motors.clear();
  world.control->callback = [](double time, std::span<const BodyState>, std::span<const JointSample> joints,
                               std::span<double> efforts) { efforts[0] = time + joints[0].coordinate; };
  ControlledWorld controlled(world);
  Recorded run;
  Notes notes(run);
  controlled.change(std::vector<BodyState>{turned(world, 0)}, notes);
  controlled.change(std::vector<BodyState>{turned(world, 0.5)}, notes);
  EXPECT_NEAR(controlled.world().joints[0].effort, 0.75, 1e-15);
}

}  // namespace
}  // namespace careen
