#include "runs/run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/input_error.h"

namespace careen {
namespace {

// Falls 5 m onto a floor in a second.
SceneText falling(const std::string& more = "") {
  return {.text = R"({"careen": 1, "duration": 3, "gravity": [0, 0, -10], "tolerance": 1e-6,
                      "walls": [{"name": "floor", "point": [0, 0, 0], "normal": [0, 0, 1], "restitution": 0.5}],
                      "boxes": [{"name": "crate", "half_extents": [0.5, 0.5, 0.5], "mass": 1,
                                 "position": [0, 0, 5.5])" +
                  more + "}]}",
          .name = "falling.json"};
}

std::vector<std::string> noticesOf(const SceneText& scene, Simulation how) {
  std::vector<std::string> notices;
  how.notice = [&](const std::string& each) { notices.push_back(each); };
  static_cast<void>(simulateScene(scene, how));
  return notices;
}

TEST(SimulateScene, endsWhereTheStatementBecomesTrue) {
  const careen::Run whole = simulateScene(falling(), {});
  EXPECT_FALSE(whole.until.has_value());
  EXPECT_EQ(whole.trajectory.settings.duration, 3);
  const careen::Run ended = simulateScene(falling(), {.until = "crate touches floor"});
  ASSERT_TRUE(ended.until.has_value());
  EXPECT_NEAR(ended.until->time.value(), 1, 1e-12);
  EXPECT_NEAR(ended.trajectory.settings.duration, 1, 1e-12);
  const careen::Run never = simulateScene(falling(), {.until = "height(crate) > 6"});
  EXPECT_FALSE(never.until->time.has_value());
  EXPECT_EQ(never.trajectory.stateHash(), whole.trajectory.stateHash());
  Simulation wrong{.until = "crate tickles floor"};
  wrong.overrides.sign = "--";
  EXPECT_TRUE(inputErrorOf([&] { simulateScene(falling(), wrong); }).starts_with("--until: "));
}

TEST(SimulateScene, tellsWhatItHasInPlaceOfTheScenes) {
  EXPECT_TRUE(noticesOf(falling(), {}).empty());
  Simulation shorter;
  shorter.overrides.duration = 2;
  const std::vector<std::string> told = noticesOf(falling(), shorter);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0], "duration 2 from the command line (the scene says 3)");
  Simulation apart;
  apart.overrides.allowOverlap = true;
  const std::vector<std::string> moved = noticesOf(falling(R"(}, {"half_extents": [0.5, 0.5, 0.5], "mass": 1,
                                                       "position": [0.9, 0, 5.5])"),
                                                   apart);
  ASSERT_EQ(moved.size(), 1U);
  EXPECT_TRUE(moved[0].starts_with("moved apart 1 pair of boxes that overlapped: ")) << moved[0];
}

TEST(SimulateScene, changesTheWorldThatBegins) {
  Simulation weightless;
  weightless.change = [](World& world) { world.gravity = Vec3::Zero(); };
  const careen::Run run = simulateScene(falling(), weightless);
  EXPECT_EQ(run.trajectory.state(0, 3).pose.position.z(), 5.5);
}

// A run that says less of its errors than the audit finds has the audit's figures.
TEST(AuditRun, figuresOfTheAuditStandWhereTheyAreLarger) {
  careen::Run run = simulateScene(falling(), {});
  auditRun(run, AuditDepth::kFull, {});
  EXPECT_TRUE(run.audit.breaches.empty());
  EXPECT_EQ(run.statedFigures().energyChange, run.trajectory.figures.energyChange);
  for (AuditFigure& figure : run.audit.figures) {
    figure.size = 0.25;
    figure.promised = true;
  }
  EXPECT_EQ(run.statedFigures().energyChange, 0.25);
  EXPECT_EQ(run.statedFigures().deepestPenetration, 0.25);
  for (AuditFigure& figure : run.audit.figures) {
    figure.promised = false;
  }
  EXPECT_EQ(run.statedFigures().energyChange, run.trajectory.figures.energyChange);
}

TEST(Estimate, isMadeIfAskedForOrCheap) {
  careen::Run run = simulateScene(falling(), {});
  run.simulateSeconds = 1;
  estimate(run, {}, 5, {});
  EXPECT_FALSE(run.estimated) << "a fifth of the whole";
  estimate(run, false, 1000, {});
  EXPECT_FALSE(run.estimated);
  estimate(run, {}, 1000, {});
  EXPECT_TRUE(run.estimated);
  EXPECT_LT(run.estimate.value().position, 1e-9);
  careen::Run asked = simulateScene(falling(), {});
  estimate(asked, true, 0, {});
  EXPECT_TRUE(asked.estimate.has_value());
  careen::Run table = simulateScene(falling(), {});
  table.trajectory.given.emplace();
  estimate(table, true, 0, {});
  EXPECT_FALSE(table.estimated);
}

}  // namespace
}  // namespace careen
