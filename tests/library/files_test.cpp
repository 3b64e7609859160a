// Files and tables of the library beside the program's: the same bytes.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "library/careen.h"
#include "support/process.h"

namespace careen::v1 {
namespace {

const std::filesystem::path kShipped = std::filesystem::path(CAREEN_SOURCE_DIR) / "assets/scenes";

class LibraryFiles : public testing::Test {
 protected:
  Ended program(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), CAREEN_BINARY);
    return Process(arguments, folder_.path()).wait();
  }

  TemporaryFolder folder_;
};

TEST_F(LibraryFiles, areThoseOfTheProgram) {
  const std::string scene = kShipped / "careen.json";
  const v1::Run run = simulate(Scene::read(scene));
  for (const std::string suffix : {".glb", ".xml", ".npz", ".csv"}) {
    const std::filesystem::path own = folder_ / ("own" + suffix);
    run.exportTo(own, 0.1);
    std::vector<std::string> arguments = {"export", scene, "-o", "theirs" + suffix};
    if (suffix == ".npz" || suffix == ".csv") {
      arguments.insert(arguments.end(), {"--every", "0.1"});
    }
    ASSERT_EQ(program(arguments).exitCode, 0) << suffix;
    EXPECT_TRUE(textOf(own) == textOf(folder_ / ("theirs" + suffix))) << suffix;
  }
  EXPECT_THROW(run.exportTo(folder_ / "run.obj"), Error);
  EXPECT_THROW(run.exportTo(folder_ / "none/run.csv"), Error);
}

// Free fall from rest, and the same 3 mm to the side: that far apart from the start, and no more.
TEST_F(LibraryFiles, differencesAreWhatTheyAre) {
  const auto fallingAt = [](const std::string& x) {
    return simulate(Scene::parse(
        R"({"careen": 1, "duration": 1, "gravity": [0, 0, -10], "boxes": [{"name": "crate",
            "half_extents": [0.5, 0.5, 0.5], "mass": 1, "position": [)" +
            x + R"(, 0, 9]}]})",
        "falling"));
  };
  const v1::Run run = fallingAt("0");
  const Difference none = run.differenceFrom(fallingAt("0"));
  EXPECT_TRUE(none.same);
  EXPECT_FALSE(none.from.has_value());
  EXPECT_EQ(none.position, 0);
  const Difference aside = run.differenceFrom(fallingAt("0.003"));
  EXPECT_FALSE(aside.same);
  EXPECT_EQ(aside.from, 0);
  EXPECT_NEAR(aside.position, 0.003, 1e-15);
  EXPECT_EQ(aside.box, "crate");
  EXPECT_FALSE(aside.horizon.has_value());
  const Difference other = run.differenceFrom(simulate(Scene::read(kShipped / "zeno.json")));
  EXPECT_FALSE(other.incomparable.empty());
}

TEST_F(LibraryFiles, sweepsMakeTheProgramsTable) {
  folder_.write("family.json",
                R"({"careen": 1, "duration": 0.5, "gravity": [0, 0, -10],
                    "boxes": [{"half_extents": [0.1, 0.1, 0.1], "mass": {"uniform": [1, 2]},
                               "position": [0, 0, {"uniform": [1, 2]}]}]})");
  const Ended ended = program({"sweep", "family.json", "--runs", "0-9", "--out", "theirs"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const SweepTable table = sweep(folder_ / "family.json", folder_ / "own", 0, 9, 2);
  EXPECT_EQ(table.rows, 10);
  EXPECT_EQ(table.broken, 0);
  EXPECT_EQ(textOf(table.path), textOf(folder_ / "theirs/table.csv"));
  EXPECT_THROW(sweep(folder_ / "family.json", folder_ / "other", 5, 4), Error);
  EXPECT_THROW(sweep(folder_ / "none.json", folder_ / "other", 0, 4), Error);
}

}  // namespace
}  // namespace careen::v1
