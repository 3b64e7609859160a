#include "sweep/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/system/file.h"
#include "support/process.h"

namespace careen {
namespace {

const std::string kFamily = R"({ "careen": 1, "name": "toss", "duration": 0.3, "gravity": [0, 0, -9.81],
  "walls": [ { "point": [0, 0, 0], "normal": [0, 0, 1], "restitution": 0.9 } ],
  "boxes": [ { "name": "die", "half_extents": [0.1, 0.1, 0.1], "mass": 1, "restitution": 0.9,
               "position": [0, 0, { "uniform": [0.3, 0.6] }], "orientation": { "rotation": "uniform" } } ] })";

class Sweep : public testing::Test {
 protected:
  SweepSettings settings(const std::string& folder, const std::string& runs, int jobs) const {
    SweepSettings settings;
    settings.folder = folder_ / folder;
    settings.runs = parseRuns(runs);
    settings.jobs = jobs;
    settings.program = "test";
    return settings;
  }
  std::string table(const std::string& folder) const { return textOf(folder_ / folder / "table.csv"); }

  TemporaryFolder folder_;
  Family family_{kFamily, "family.json"};
};

TEST_F(Sweep, tableIsTheSameHoweverTheWorkIsSplit) {
  const SweepFigures figures = runSweep(family_, kFamily, settings("one", "0-219", 1));
  EXPECT_EQ(figures.simulated, 220);
  EXPECT_EQ(figures.rows, 220);
  runSweep(family_, kFamily, settings("two", "0-219", 3));
  ASSERT_FALSE(table("one").empty());
  EXPECT_EQ(table("two"), table("one"));
  EXPECT_EQ(textOf(folder_ / "two/table.npz"), textOf(folder_ / "one/table.npz"));
  // Shares, and then who joins them.
  for (int index = 0; index < 3; ++index) {
    SweepSettings share = settings("shared", "0-219", 2);
    share.share = {.index = index, .count = 3};
    const SweepFigures part = runSweep(family_, kFamily, share);
    EXPECT_GT(part.simulated, 0);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "shared/table.csv"));
  }
  SweepSettings join = settings("shared", "0-219", 1);
  join.resume = true;
  EXPECT_EQ(runSweep(family_, kFamily, join).simulated, 0);
  EXPECT_EQ(table("shared"), table("one"));
  EXPECT_EQ(runSweep(family_, kFamily, join).skipped, 220) << "the table is there";
}

TEST_F(Sweep, partOfTheRunsHasTheirRows) {
  runSweep(family_, kFamily, settings("all", "0-99", 2));
  runSweep(family_, kFamily, settings("some", "37-39", 2));
  const std::string some = table("some");
  const std::size_t begin = some.find('\n') + 1;
  EXPECT_NE(table("all").find("\n" + some.substr(begin)), std::string::npos);
}

TEST_F(Sweep, stoppedOneIsResumedToTheSameTable) {
  runSweep(family_, kFamily, settings("whole", "0-499", 2));
  std::stop_source stop;
  SweepSettings cut = settings("cut", "0-499", 2);
  EXPECT_THROW(
      runSweep(
          family_, kFamily, cut, [&](const SweepProgress&) { stop.request_stop(); }, stop.get_token()),
      Interrupted);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "cut/table.csv"));
  cut.resume = true;
  const SweepFigures figures = runSweep(family_, kFamily, cut);
  EXPECT_GT(figures.skipped, 0);
  EXPECT_EQ(figures.skipped + figures.simulated, 500);
  EXPECT_EQ(table("cut"), table("whole"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "cut/rows"));
}

TEST_F(Sweep, folderOfSomethingElseIsRefusedAndKept) {
  folder_.write("notes", "mine");
  std::filesystem::create_directory(folder_ / "other");
  std::filesystem::rename(folder_ / "notes", folder_ / "other/notes");
  EXPECT_THROW(runSweep(family_, kFamily, settings("other", "0-9", 1)), InputError);
  EXPECT_EQ(folder_.files(), (std::vector<std::string>{"other", "other/notes"}));
  runSweep(family_, kFamily, settings("sweep", "0-9", 1));
  SweepSettings more = settings("sweep", "0-19", 1);
  more.resume = true;
  EXPECT_THROW(runSweep(family_, kFamily, more), InputError);
  more.resume = false;
  EXPECT_EQ(runSweep(family_, kFamily, more).rows, 20) << "a new sweep takes the old one's place";
}

TEST_F(Sweep, keepsTrajectoriesIfAsked) {
  SweepSettings keep = settings("keep", "7-8", 2);
  keep.keepRuns = true;
  runSweep(family_, kFamily, keep);
  EXPECT_GT(textOf(folder_ / "keep/runs/0000007.careen").size(), 100U);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "keep/runs/0000008.careen"));
}

// Stands for a film: two files of each run.
void writeTwoFiles(Trajectory& run, const std::filesystem::path& folder, const std::stop_token& /*stop*/) {
  writeFile(folder / "film.json", run.stateHash());
  writeFile(folder / "truth.json", "2");
}

TEST_F(Sweep, filesOfRunsAreWholeFoldersAndThoseThatAreThereAreNotMadeAgain) {
  SweepSettings filmed = settings("filmed", "3-12", 2);
  filmed.writeRun = writeTwoFiles;
  filmed.written = {{"film", "yes"}};
  runSweep(family_, kFamily, settings("plain", "3-12", 2));
  runSweep(family_, kFamily, filmed);
  EXPECT_EQ(table("filmed"), table("plain"));
  const std::vector<std::string> whole = folder_.files();
  EXPECT_EQ(std::count_if(whole.begin(), whole.end(),
                          [](const std::string& name) { return name.ends_with("/truth.json"); }),
            10);
  // Killed where run 7 had its first file, and another run's folder was lost.
  SweepSettings cut = settings("cut", "3-12", 1);
  cut.written = filmed.written;
  const std::filesystem::path lost = cut.folder / "runs/0000005";
  cut.writeRun = [](Trajectory& run, const std::filesystem::path& folder, const std::stop_token& stop) {
    writeTwoFiles(run, folder, stop);
    if (folder.filename().string().starts_with(".0000007")) {
      std::filesystem::remove(folder / "truth.json");
      raise(SIGKILL);
    }
  };
  EXPECT_THROW(runSweep(family_, kFamily, cut), MachineError);
  EXPECT_TRUE(std::filesystem::exists(cut.folder / "runs/0000006"));
  EXPECT_FALSE(std::filesystem::exists(cut.folder / "runs/0000007"));
  std::filesystem::remove_all(lost);
  cut.writeRun = writeTwoFiles;
  cut.resume = true;
  const SweepFigures figures = runSweep(family_, kFamily, cut);
  EXPECT_EQ(figures.skipped, 3) << "runs 3, 4 and 6";
  EXPECT_EQ(figures.simulated, 7);
  EXPECT_EQ(table("cut"), table("filmed"));
  EXPECT_EQ(textOf(lost / "film.json"), textOf(filmed.folder / "runs/0000005/film.json"));
  cut.written.clear();
  EXPECT_THROW(runSweep(family_, kFamily, cut), InputError) << "without the films it is another sweep";
}

TEST_F(Sweep, oneWhoseFirstFileCannotBeWrittenLeavesNothing) {
  SweepSettings broken = settings("broken", "0-9", 2);
  broken.writeRun = [](Trajectory&, const std::filesystem::path& folder, const std::stop_token&) {
    writeFile(folder / "film.json", "");
    throw InputError("frames: found 90, expected frames from 0 to 8");
  };
  try {
    runSweep(family_, kFamily, broken);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kBadInput);
    EXPECT_TRUE(std::string(error.what()).starts_with("family.json (run ")) << error.what();
  }
  EXPECT_EQ(folder_.files(), std::vector<std::string>());
}

// A sweep that begins anew would remove the rows of the one that is working.
TEST_F(Sweep, secondOneInAFolderIsRefusedWhileTheFirstWorks) {
  SweepSettings first = settings("toss", "0-199", 1);
  SweepSettings second = first;
  SweepSettings resumed = first;
  resumed.resume = true;
  int refused = 0;
  const SweepFigures figures = runSweep(family_, kFamily, first, [&](const SweepProgress& now) {
    if (now.done == 50) {
      for (const SweepSettings& other : {second, resumed}) {
        try {
          runSweep(family_, kFamily, other);
        } catch (const InputError& error) {
          refused += std::string(error.what()).find("another careen is writing there") != std::string::npos;
        }
      }
    }
  });
  EXPECT_EQ(refused, 2);
  EXPECT_EQ(figures.rows, 200);
  EXPECT_EQ(runSweep(family_, kFamily, second).rows, 200) << "the folder is free again";
}

TEST_F(Sweep, sharesWorkInOneFolderAtTheSameTime) {
  runSweep(family_, kFamily, settings("whole", "0-199", 1));
  SweepSettings first = settings("parts", "0-199", 1);
  first.share = {.index = 0, .count = 2};
  SweepSettings second = first;
  second.share.index = 1;
  std::int64_t simulated = 0;
  runSweep(family_, kFamily, first, [&](const SweepProgress& now) {
    if (now.done == 50) {
      simulated = runSweep(family_, kFamily, second).simulated;
    }
  });
  EXPECT_EQ(simulated, 100);
  SweepSettings join = settings("parts", "0-199", 1);
  join.resume = true;
  EXPECT_EQ(runSweep(family_, kFamily, join).simulated, 0);
  EXPECT_EQ(table("parts"), table("whole"));
}

TEST_F(Sweep, runThatCannotBeMadeEndsItWithItsName) {
  std::string text = kFamily;  // one of four has no mass
  text.replace(text.find("\"mass\": 1"), 9, "\"mass\": { \"choice\": [1, 1, 1, 0] }");
  std::string seeded = text;
  for (int seed = 1;; ++seed) {  // one whose run 0 can be made
    seeded = text;
    seeded.replace(seeded.find("\"careen\": 1,"), 12,
                   "\"careen\": 1, \"sweep\": { \"seed\": " + std::to_string(seed) + " },");
    try {
      const Family family(seeded, "bad.json");
      break;
    } catch (const InputError&) {
      ASSERT_LT(seed, 50);
    }
  }
  try {
    runSweep(Family(seeded, "bad.json"), seeded, settings("bad", "0-99", 2));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kBadInput);
    EXPECT_TRUE(std::string(error.what()).starts_with("bad.json (run ")) << error.what();
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "bad/table.csv"));
}

TEST(SweepOptions, areReadStrictly) {
  EXPECT_EQ(parseRuns("3-9").last, 9);
  EXPECT_EQ(parseRuns("17").first, 17);
  for (const char* bad : {"", "-1", "9-3", "0-10000000", "0-9:2", "a", "1-", "99999999999999999999"}) {
    EXPECT_THROW(parseRuns(bad), InputError) << bad;
  }
  EXPECT_EQ(parseShare("2/10").index, 2);
  for (const char* bad : {"", "10/10", "-1/10", "1", "0/0", "1/2/3"}) {
    EXPECT_THROW(parseShare(bad), InputError) << bad;
  }
}

}  // namespace
}  // namespace careen
