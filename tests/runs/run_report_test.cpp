#include "runs/run_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace careen {
namespace {

// A second of flight, then at rest.
Run dropped() {
  return simulateScene(SceneText{.text = R"({"careen": 1, "duration": 4, "gravity": [0, 0, -10],
      "walls": [{"name": "floor", "point": [0, 0, 0], "normal": [0, 0, 1]}],
      "boxes": [{"name": "crate", "half_extents": [0.5, 0.5, 0.5], "mass": 1, "position": [0, 0, 5.5]},
                {"name": "rock", "half_extents": [0.5, 0.5, 0.5], "fixed": true, "position": [9, 0, 5.5]}]})",
                                 .name = "dropped.json"},
                       {});
}

TEST(LifeOf, isTimeInFlightAndAtRestOfWhatCanMove) {
  const Life life = lifeOf(dropped().trajectory);
  EXPECT_NEAR(life.flight, 1, 1e-12);
  EXPECT_NEAR(life.rest, 3, 1e-12);
  EXPECT_NEAR(life.whole(), 4, 1e-12) << "the rock has none";
}

TEST(RunReport, hasAPartForAllThatWasDone) {
  careen::Run run = dropped();
  nlohmann::ordered_json report = runReport(run, 1.5);
  EXPECT_EQ(report["wall_seconds"], 1.5);
  EXPECT_EQ(report["impacts"], 4) << "one for each corner";
  EXPECT_EQ(report["state_hash"], run.trajectory.stateHash());
  EXPECT_NEAR(report["life"][0]["flight"].get<double>(), 1, 1e-12);
  for (const char* const part : {"audit", "error_estimate", "until", "given"}) {
    EXPECT_FALSE(report.contains(part)) << part;
  }
  auditRun(run, AuditDepth::kUsual, {});
  estimate(run, true, 0, {});
  run.until = {.question = "rest", .time = {}};
  report = nlohmann::ordered_json::parse(runReportText(run, 1.5));
  EXPECT_EQ(report["audit"]["box_overlap"]["unit"], "m");
  EXPECT_TRUE(report["breaches"].empty());
  EXPECT_LT(report["error_estimate"]["position"], 1e-9);
  EXPECT_TRUE(report["until"]["time"].is_null());
  run.trajectory.given.emplace();
  EXPECT_FALSE(runReport(run, 1).contains("contact_residuals"));
}

}  // namespace
}  // namespace careen
