#include "study/case.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <stop_token>
#include <string>
#include <vector>

#include "core/error.h"
#include "support/environment_variable.h"
#include "support/input_error.h"
#include "support/process.h"

namespace careen {
namespace {

// 2 s there and 2 s back; a copy whose 2 s are 1/4 of the original's 8 s.
TEST(Case, simulatesAsLongAsItsMeasureTakes) {
  Case study;
  study.times = {1, 2};
  EXPECT_EQ(study.duration(), 2);
  for (const Measure measure : {Measure::kPoses, Measure::kEnergy, Measure::kOverlap}) {
    study.measure = measure;
    EXPECT_EQ(study.simulated(), 2);
  }
  study.measure = Measure::kReversal;
  EXPECT_EQ(study.simulated(), 4);
  study.measure = Measure::kScaled;
  study.durations = 0.25;
  EXPECT_EQ(study.simulated(), 10);
}

TEST(Case, ofEveryNameCanBeReadAndIsWhole) {
  const std::vector<std::string> names = caseNames();
  EXPECT_GT(names.size(), 20U);
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  std::set<Measure> measures;
  for (const std::string& name : names) {
    const Case study = readCase(name);
    SCOPED_TRACE(name);
    EXPECT_EQ(study.name, name);
    EXPECT_NE(study.title, "");
    EXPECT_NE(study.whyHard, "");
    EXPECT_NE(study.source, "");
    EXPECT_GT(study.duration(), 0);
    EXPECT_FALSE(study.world.bodies.empty());
    measures.insert(study.measure);
    EXPECT_EQ(study.poses.size(), study.measure == Measure::kPoses ? study.times.size() : 0U);
    for (const std::vector<Pose>& moment : study.poses) {
      EXPECT_EQ(moment.size(), study.world.bodies.size());
    }
    EXPECT_EQ(study.original.bodies.size(),
              study.measure == Measure::kScaled ? study.world.bodies.size() : 0U);
  }
  EXPECT_EQ(measures.size(), 5U);
}

TEST(Case, withoutItsTruthIsRefused) {
  const std::string message = inputErrorOf([] { readCase("no-such-case"); });
  EXPECT_TRUE(message.ends_with(
      "assets/truths/no-such-case.json: found no file, expected the truth of the case no-such-case"))
      << message;
}

// What reading a truth says where the program's data are it and one scene.
std::string messageOfTruth(const std::string& truth) {
  const TemporaryFolder data;
  std::filesystem::create_directories(data / "assets/truths");
  std::filesystem::create_directories(data / "assets/scenes");
  data.write("assets/truths/fall.json", truth);
  data.write("assets/scenes/fall.json", R"({ "careen": 1, "name": "a fall", "duration": 0.5,
    "boxes": [ { "half_extents": [1, 1, 1], "mass": 1 } ] })");
  const EnvironmentVariable folder("CAREEN_DATA", data.path().string());
  return inputErrorOf([] { readCase("fall"); });
}

TEST(Case, withoutItsSceneNamesFileAndKey) {
  const std::string head = R"({"title": "t", "why_hard": "w", "source": "s", )";
  const std::string message = messageOfTruth(head + R"("measure": "energy", "scene": "hard/none.json"})");
  EXPECT_TRUE(message.ends_with(
      R"(assets/truths/fall.json: scene: found "hard/none.json", expected a file of assets/scenes)"))
      << message;
  const std::string of =
      messageOfTruth(head + R"("measure": "scaled", "scene": "fall.json", "of": "none.json"})");
  EXPECT_TRUE(
      of.ends_with(R"(assets/truths/fall.json: of: found "none.json", expected a file of assets/scenes)"))
      << of;
}

// x = t, z = −5 t².
TEST(Case, ofASceneIsWhatExactSaysOfIt) {
  const TemporaryFolder folder;
  folder.write("fall.json", R"({ "careen": 1, "name": "a fall", "duration": 0.5, "gravity": [0, 0, -10],
    "boxes": [ { "half_extents": [1, 1, 1], "mass": 1, "velocity": [1, 0, 0] } ] })");
  const Case study = caseOfScene(folder / "fall.json", {});
  EXPECT_EQ(study.name, "fall");
  EXPECT_EQ(study.title, "a fall");
  EXPECT_EQ(study.measure, Measure::kPoses);
  ASSERT_EQ(study.times.size(), 16U);
  EXPECT_EQ(study.duration(), 0.5);
  for (std::size_t k = 0; k < study.times.size(); ++k) {
    const double t = study.times[k];
    EXPECT_EQ(t, 0.5 * static_cast<double>(k + 1) / 16);
    EXPECT_LT((study.poses[k][0].position - Vec3(t, 0, -5 * t * t)).norm(), 1e-15);
  }
  EXPECT_LT(study.uncertainty, 1e-14);
}

TEST(Case, ofASceneThatExactCannotRunIsNone) {
  const TemporaryFolder folder;
  folder.write("bad.json", "{");
  EXPECT_NE(inputErrorOf([&] { caseOfScene(folder / "bad.json", {}); }).find("bad.json"), std::string::npos);
}

}  // namespace
}  // namespace careen
