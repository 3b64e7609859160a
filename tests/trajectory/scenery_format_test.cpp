#include "trajectory/scenery_format.h"

#include <gtest/gtest.h>

#include <string>

#include "core/error.h"
#include "support/trajectories.h"
#include "trajectory/trajectory_file.h"

namespace careen {
namespace {

Trajectory shown() {
  Trajectory run = driftAndReturn();
  run.stage.scenery = {.towardsLight = Vec3(0, -0.6, 0.8),
                       .lightDegrees = 8,
                       .lightColor = Color{0xff, 0xe0, 0xc0},
                       .ambient = ColorPair{{0x40, 0x50, 0x60}, {1, 2, 3}},
                       .background = ColorPair{{4, 5, 6}, {0xff, 7, 8}},
                       .gloss = 0.75,
                       .marks = false,
                       .titles = {{.from = 0, .to = 1.5, .text = "A box", .place = TitlePlace::kTop},
                                  {.from = 0.5, .to = 1, .text = "Part 4"}}};
  run.stage.cameraMove.easing = Easing::kLinear;
  run.stage.focus = Focus{.fStop = 0.125, .body = 0, .samples = 5};
  return run;
}

// Every key another value than what holds without it.
TEST(SceneryFormat, bringsBackAllThatIsSaidOfHowARunIsShown) {
  const Trajectory run = shown();
  const std::string bytes = encodeTrajectory(run);
  const Trajectory back = decodeTrajectory(bytes, "run.careen");
  EXPECT_EQ(encodeTrajectory(back), bytes);
  const Scenery& scenery = back.stage.scenery;
  EXPECT_EQ(scenery.towardsLight, run.stage.scenery.towardsLight);
  EXPECT_EQ(scenery.lightDegrees, 8);
  EXPECT_EQ(scenery.lightColor->green, 0xe0);
  EXPECT_EQ(scenery.ambient->above.green, 0x50);
  EXPECT_EQ(scenery.background->below.red, 0xff);
  EXPECT_EQ(scenery.gloss, 0.75);
  EXPECT_EQ(scenery.marks, false);
  ASSERT_EQ(scenery.titles.size(), 2U);
  EXPECT_EQ(scenery.titles[0].place, TitlePlace::kTop);
  EXPECT_EQ(scenery.titles[1].text, "Part 4");
  EXPECT_EQ(scenery.titles[1].from, 0.5);
  EXPECT_EQ(back.stage.cameraMove.easing, Easing::kLinear);
  EXPECT_EQ(back.stage.focus->body, 0U);
  EXPECT_EQ(back.stage.focus->samples, 5);
}

TEST(SceneryFormat, refusesLightsThatNobodyCanDraw) {
  const Trajectory run = shown();
  const auto isRefused = [&run](const auto& change) {
    Trajectory changed = run;
    change(changed.stage);
    EXPECT_THROW(decodeTrajectory(encodeTrajectory(changed), "run.careen"), InputError);
  };
  isRefused([](Stage& stage) { stage.scenery.towardsLight = Vec3(1, 1, 0); });
  isRefused([](Stage& stage) { stage.scenery.lightDegrees = 61; });
  isRefused([](Stage& stage) { stage.scenery.gloss = -0.5; });
  isRefused([](Stage& stage) { stage.scenery.titles[0].to = 0; });
  isRefused([](Stage& stage) { stage.focus->body = 99; });
  isRefused([](Stage& stage) { stage.focus->samples = 0; });
}

}  // namespace
}  // namespace careen
