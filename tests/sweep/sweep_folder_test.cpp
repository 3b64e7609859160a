#include "sweep/sweep_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/system/file.h"
#include "support/process.h"

namespace careen {
namespace {

using Names = std::vector<std::string>;

const std::string kManifest = R"({ "family_hash": "a", "runs": "0-9" })";

class SweepFolders : public testing::Test {
 protected:
  // A sweep that ended, with the film of a run.
  void leaveOne() const {
    std::filesystem::create_directories(folder_ / "toss/runs/0000003");
    folder_.write("toss/sweep.json", kManifest);
    folder_.write("toss/table.csv", "rows");
    folder_.write("toss/runs/0000003/000000.png", "picture");
    folder_.write("toss/runs/0000003/film.json", "film");
    folder_.write("toss/runs/0000003.careen", "run");
  }
  std::string refusal(const std::string& manifest, SweepOpening opening) const {
    const Names before = folder_.files();
    try {
      const SweepFolder sweep(folder_ / "toss", manifest, opening);
    } catch (const InputError& error) {
      EXPECT_EQ(folder_.files(), before);
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder_;
};

TEST_F(SweepFolders, whatNothingWasWrittenIntoIsRemoved) {
  for (const SweepOpening opening : {SweepOpening::kAnew, SweepOpening::kResumed}) {
    {
      const SweepFolder sweep(folder_ / "toss", kManifest, opening);
      EXPECT_EQ(readFile(folder_ / "toss/sweep.json"), kManifest);
      EXPECT_TRUE(std::filesystem::is_directory(sweep.rows()));
      EXPECT_TRUE(std::filesystem::is_directory(sweep.runs()));
    }
    EXPECT_EQ(folder_.files(), Names());
  }
}

TEST_F(SweepFolders, rowsStayAndPartialFilesDoNot) {
  {
    const SweepFolder sweep(folder_ / "toss", kManifest, SweepOpening::kAnew);
    writeFile(sweep.rows() / "0000000-0000009.csv", "rows");
    writeFile(sweep.rows() / ".0000010-0000019.csv.17.partial", "ro");
    std::filesystem::create_directory(sweep.runs() / ".0000003.17.partial");
  }
  EXPECT_EQ(folder_.files(),
            (Names{"toss", "toss/rows", "toss/rows/0000000-0000009.csv", "toss/sweep.json"}));
  const SweepFolder sweep(folder_ / "toss", kManifest, SweepOpening::kResumed);
  EXPECT_EQ(readFile(sweep.rows() / "0000000-0000009.csv"), "rows");
}

TEST_F(SweepFolders, onlySharesMayMeetThere) {
  const SweepFolder one(folder_ / "toss", kManifest, SweepOpening::kShared);
  const SweepFolder other(folder_ / "toss", kManifest, SweepOpening::kShared);
  EXPECT_NE(refusal(kManifest, SweepOpening::kAnew).find("another careen is writing there"),
            std::string::npos);
  EXPECT_NE(refusal(kManifest, SweepOpening::kResumed).find("another careen is writing there"),
            std::string::npos);
}

TEST_F(SweepFolders, shareLeavesTheOthersFilesAlone) {
  {
    const SweepFolder one(folder_ / "toss", kManifest, SweepOpening::kShared);
    writeFile(one.rows() / ".0000010-0000019.csv.17.partial", "ro");  // of another share, which is writing
  }
  EXPECT_TRUE(std::filesystem::exists(folder_ / "toss/rows/.0000010-0000019.csv.17.partial"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "toss/.careen.lock"));
}

TEST_F(SweepFolders, newSweepTakesTheEarlierOnesPlace) {
  leaveOne();
  { const SweepFolder sweep(folder_ / "toss", "{}", SweepOpening::kAnew); }
  EXPECT_EQ(folder_.files(), Names{"toss"}) << "nothing was written, and what was there is removed";
}

TEST_F(SweepFolders, resumedOneMustBeTheSameAndTheMessageNamesWhatDiffers) {
  leaveOne();
  EXPECT_TRUE(SweepFolder::isFinished(folder_ / "toss", kManifest));
  const std::string other = R"({ "family_hash": "a", "runs": "0-19", "film": "yes" })";
  EXPECT_FALSE(SweepFolder::isFinished(folder_ / "toss", other));
  for (const SweepOpening opening : {SweepOpening::kResumed, SweepOpening::kShared}) {
    EXPECT_NE(refusal(other, opening).find("(sweep.json differs in: runs, film)"), std::string::npos)
        << refusal(other, opening);
  }
  folder_.write("toss/sweep.json", "no JSON");
  EXPECT_NE(refusal(other, SweepOpening::kResumed).find("differs in: its text"), std::string::npos);
  EXPECT_EQ(readFile(folder_ / "toss/table.csv"), "rows");
}

TEST_F(SweepFolders, filesOfOthersAreKeptAndNamed) {
  leaveOne();
  folder_.write("toss/runs/0000003/notes", "mine");
  EXPECT_NE(refusal(kManifest, SweepOpening::kAnew).find("runs/0000003/notes: is no file of a sweep's run"),
            std::string::npos);
  std::filesystem::remove(folder_ / "toss/sweep.json");
  EXPECT_NE(refusal(kManifest, SweepOpening::kAnew).find("holds other files"), std::string::npos);
}

}  // namespace
}  // namespace careen
