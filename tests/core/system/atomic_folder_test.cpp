#include "core/system/atomic_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "core/error.h"
#include "core/system/cleanup.h"
#include "core/system/file.h"
#include "support/process.h"

namespace careen {
namespace {

using FileNames = std::vector<std::string>;

TEST(AtomicFolder, isThereAfterCommitAndNotBefore) {
  const TemporaryFolder folder;
  {
    AtomicFolder made(folder / "film");
    writeFile(made.path() / "one", "1");
    EXPECT_FALSE(std::filesystem::exists(folder / "film"));
    made.commit();
    EXPECT_EQ(folder.files(), (FileNames{"film", "film/one"}));
  }
  EXPECT_EQ(folder.files(), (FileNames{"film", "film/one"}));
}

TEST(AtomicFolder, withoutCommitNothingIsLeft) {
  const TemporaryFolder folder;
  {
    const AtomicFolder made(folder / "film");
    writeFile(made.path() / "one", "1");
  }
  EXPECT_EQ(folder.files(), FileNames());
}

TEST(AtomicFolder, oneThatIsThereStays) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "film");
  writeFile(folder / "film/one", "first");
  {
    AtomicFolder made(folder / "film");
    writeFile(made.path() / "one", "second");
    made.commit();
  }
  EXPECT_EQ(folder.files(), (FileNames{"film", "film/one"}));
  EXPECT_EQ(readFile(folder / "film/one"), "first");
}

TEST(AtomicFolder, takesThePlaceOfAnother) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "film");
  writeFile(folder / "film/one", "first");
  writeFile(folder / "film/other", "first");
  {
    AtomicFolder made(folder / "film");
    writeFile(made.path() / "one", "second");
    made.replace();
    EXPECT_EQ(readFile(folder / "film/one"), "second");
  }
  EXPECT_EQ(folder.files(), (FileNames{"film", "film/one"}));
}

TEST(AtomicFolder, cannotTakeThePlaceOfNothing) {
  const TemporaryFolder folder;
  {
    AtomicFolder made(folder / "film");
    EXPECT_THROW(made.replace(), MachineError);
  }
  EXPECT_EQ(folder.files(), FileNames());
}

// As an interruption does, from another thread.
TEST(AtomicFolder, thatIsRemovedAlreadyTakesNoPlace) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "film");
  writeFile(folder / "film/one", "first");
  EXPECT_EXIT(
      {
        AtomicFolder made(folder / "film");
        writeFile(made.path() / "one", "second");
        std::thread([] { cleanUpToEnd(); }).join();
        try {
          made.replace();
        } catch (const Interrupted&) {
          std::_Exit(readFile(folder / "film/one") == "first" ? 7 : 8);
        }
      },
      testing::ExitedWithCode(7), "");
}

TEST(AtomicFolder, placeThatCannotBeWrittenToIsAMachineError) {
  const TemporaryFolder folder;
  folder.write("file", "");
  EXPECT_THROW(AtomicFolder made(folder / "file/film"), MachineError);
  AtomicFolder made(folder / "file");
  EXPECT_THROW(made.commit(), MachineError);
}

TEST(AtomicFolder, whatKilledProcessesLeftIsRemovedAndNothingElse) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / ".film.17.partial");
  folder.write(".film.17.partial/one", "");
  folder.write(".rows.17.partial", "");
  folder.write("mine.partial", "");
  folder.write(".mine", "");
  removePartials(folder.path());
  EXPECT_EQ(folder.files(), (FileNames{".mine", "mine.partial"}));
  EXPECT_NO_THROW(removePartials(folder / "missing"));
}

}  // namespace
}  // namespace careen
