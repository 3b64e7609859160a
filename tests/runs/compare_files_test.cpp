#include "runs/compare_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "image/pictures.h"
#include "image/png.h"
#include "runs/run.h"
#include "support/input_error.h"
#include "support/process.h"
#include "trajectory/export_csv.h"
#include "trajectory/trajectory_file.h"

namespace careen {
namespace {

class CompareFiles : public testing::Test {
 protected:
  CompareFiles() {
    const careen::Run run =
        simulateScene(SceneText{.text = R"({"careen": 1, "duration": 1, "gravity": [0, 0, -10],
        "boxes": [{"name": "crate", "half_extents": [0.5, 0.5, 0.5], "mass": 1, "position": [0, 0, 9]}]})",
                                .name = "falling.json"},
                      {});
    saveTrajectory(run.trajectory, folder_ / "run.careen");
    folder_.write("poses.csv", "");
    std::string table;
    writePosesCsv(run.trajectory, 0.125, [&](std::string_view text) { table += text; });
    folder_.write("poses.csv", table);
    writePng(folder_ / "picture.png", shadedTiles(32, 16));
    for (const char* const name : {"one", "two"}) {
      std::filesystem::create_directory(folder_ / name);
      writePng(folder_ / name / "frame.png", shadedTiles(32, 16));
    }
  }
  Comparison compared(const std::string& expected, const std::string& actual,
                      const ComparisonSettings& settings = {}) {
    return compareFiles(folder_ / expected, folder_ / actual, settings, {});
  }

  TemporaryFolder folder_;
};

TEST_F(CompareFiles, takesTwoOfOneKind) {
  EXPECT_EQ(compared("picture.png", "picture.png").verdict, Verdict::kSame);
  EXPECT_EQ(compared("one", "two").frames.size(), 1U);
  EXPECT_TRUE(compared("run.careen", "run.careen").run->sameBits);
  for (const auto& [expected, actual] : std::vector<std::pair<std::string, std::string>>{
           {"picture.png", "one"}, {"one", "run.careen"}, {"run.careen", "picture.png"}}) {
    EXPECT_NE(inputErrorOf([&] {
                compared(expected, actual);
              }).find("expected two pictures, two folders or two runs"),
              std::string::npos);
  }
  EXPECT_NE(inputErrorOf([&] { compared("run.careen", "none"); }).find("none: is not there"),
            std::string::npos);
}

// Exact where it has rows, so that they are the same there; what is in between is another's.
TEST_F(CompareFiles, aTableIsOfTheOtherRunsSceneAndAudited) {
  const Comparison comparison = compared("run.careen", "poses.csv", {.motionTolerance = 1e-9});
  EXPECT_EQ(comparison.verdict, Verdict::kSame) << comparison.headline;
  EXPECT_EQ(comparison.run->firstBroken, "");
  std::string jump = textOf(folder_ / "poses.csv");
  const std::size_t last = jump.rfind("\n1,crate,0,");
  ASSERT_NE(last, std::string::npos) << jump;
  folder_.write("poses.csv", jump.replace(last, 11, "\n1,crate,5,"));
  EXPECT_EQ(compared("run.careen", "poses.csv", {.motionTolerance = 1e-9}).verdict, Verdict::kDifferent);
  EXPECT_FALSE(compared("run.careen", "poses.csv", {.motionTolerance = 1e-9}).run->firstBroken.empty());
  EXPECT_NE(inputErrorOf([&] { compared("poses.csv", "poses.csv"); }).find("expected --scene"),
            std::string::npos);
}

TEST_F(CompareFiles, settingsOfAnotherKindAreRefused) {
  ComparisonSettings settings;
  settings.ignored.add("0,0,1,1");
  EXPECT_NE(
      inputErrorOf([&] { compared("run.careen", "run.careen", settings); }).find("--ignore: found two runs"),
      std::string::npos);
  EXPECT_NE(
      inputErrorOf([&] { compared("one", "two", {.motionTolerance = 0.1}); }).find("found 0.1 and a folder"),
      std::string::npos);
}

TEST_F(CompareFiles, aReportLiesOutsideOfWhatIsCompared) {
  EXPECT_NO_THROW(refuseReportIn(folder_ / "report", folder_ / "one", folder_ / "two"));
  for (const char* const place : {"one", "one/report", "two/../one/", "./two"}) {
    EXPECT_THROW(refuseReportIn(folder_ / place, folder_ / "one", folder_ / "two"), InputError) << place;
  }
  folder_.write("film.json", "{}");
  EXPECT_THROW(refuseReportIn(folder_.path(), folder_ / "one", folder_ / "two"), InputError);
}

}  // namespace
}  // namespace careen
