// Files and tables of the library beside the program's: the same bytes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "image/png.h"
#include "library/beside_program.h"
#include "library/careen.h"

namespace careen::v1 {
namespace {

const std::filesystem::path kShipped = std::filesystem::path(CAREEN_SOURCE_DIR) / "assets/scenes";

using LibraryFiles = BesideProgram;

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
    ASSERT_EQ(ended(arguments).exitCode, 0) << suffix;
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
  const Ended done = ended({"sweep", "family.json", "--runs", "0-9", "--out", "theirs", "--when",
                            "height(box-0) < 1", "--estimate-error"});
  ASSERT_EQ(done.exitCode, 0) << done.err;
  const SweepTable table = sweep({.family = folder_ / "family.json",
                                  .folder = folder_ / "own",
                                  .last = 9,
                                  .when = {"height(box-0) < 1"},
                                  .estimateErrors = true,
                                  .jobs = 2});
  EXPECT_EQ(table.rows, 10);
  EXPECT_EQ(table.broken, 0);
  EXPECT_EQ(textOf(table.path), textOf(folder_ / "theirs/table.csv"));
  const std::filesystem::path other = folder_ / "other";
  EXPECT_THROW(sweep({.family = folder_ / "family.json", .folder = other, .first = 5, .last = 4}), Error);
  EXPECT_THROW(sweep({.family = folder_ / "none.json", .folder = other}), Error);
}

// A black picture, and one of which a part is grey: 1 % of the pixels, off by .2.
TEST_F(LibraryFiles, comparisonsAreThoseOfTheProgram) {
  Picture picture{.width = 100, .height = 50, .rgb = std::vector<std::uint8_t>(100 * 50 * 3)};
  writePng(folder_ / "black.png", picture);
  std::fill_n(picture.rgb.begin(), 50 * 3, std::uint8_t{51});
  writePng(folder_ / "grey.png", picture);
  const std::string black = folder_ / "black.png";
  const std::string grey = folder_ / "grey.png";
  EXPECT_TRUE(compare(black, black).same);
  const Comparison differs = compare(black, grey, {}, folder_ / "own");
  EXPECT_FALSE(differs.same);
  EXPECT_EQ(differs.different, std::vector<std::string>{"grey.png"});
  EXPECT_EQ(ended({"compare", black, grey, "-o", "theirs"}).exitCode, 1);
  EXPECT_EQ(differs.report, textOf(folder_ / "theirs/report.json"));
  EXPECT_EQ(textOf(folder_ / "own/index.html"), textOf(folder_ / "theirs/index.html"));
  const Allowed allowed{.threshold = "exact", .limits = {"fail=0.1", "failpercent=1"}};
  const Comparison same = compare(black, grey, allowed, folder_ / "own");
  EXPECT_TRUE(same.same) << same.headline;
  EXPECT_EQ(ended({"compare", black, grey, "-o", "theirs", "--threshold", "exact", "--allow",
                   "fail=0.1,failpercent=1"})
                .exitCode,
            0);
  EXPECT_EQ(same.report, textOf(folder_ / "theirs/report.json"));
  EXPECT_TRUE(compare(black, grey, {.ignored = {"0,0,50,1"}}).same);
  EXPECT_FALSE(compare(black, grey, {.ignored = {"0,0,49,1"}}).same);
  EXPECT_THROW(compare(black, grey, {.limits = {"fall=1"}}), Error);
  EXPECT_THROW(compare(black, grey, {.threshold = "nearly"}), Error);
  EXPECT_THROW(compare(black, folder_.path()), Error);
  EXPECT_THROW(compare(black, folder_ / "none.png"), Error);
}

TEST_F(LibraryFiles, runsAreComparedUpToATolerance) {
  const auto savedFrom = [&](const std::string& x) {
    const std::string path = folder_ / (x + ".careen");
    simulate(Scene::parse(R"({"careen": 1, "duration": 1, "boxes": [{"half_extents": [1, 1, 1], "mass": 1,
                              "position": [)" +
                          x + "]}]}"))
        .save(path);
    return path;
  };
  const std::string one = savedFrom("0, 0, 9");
  const std::string other = savedFrom("0, 0.003, 9");
  EXPECT_TRUE(compare(one, one).same);
  EXPECT_FALSE(compare(one, other).same);
  EXPECT_TRUE(compare(one, other, {.motion = 0.0018}).same) << "of half a diagonal, 1.732 m: 0.00173";
  EXPECT_FALSE(compare(one, other, {.motion = 0.0017}).same);
}

}  // namespace
}  // namespace careen::v1
