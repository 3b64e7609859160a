#include "core/system/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "core/error.h"

namespace careen {
namespace {

namespace fs = std::filesystem;

class FileTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) /
              ("careen-file-" + std::to_string(getpid()) + "-" + std::string(info->name()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path inFolder(const std::string& name) const { return folder_ / name; }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {}));
  }
  template <class Failing>
  static std::string messageOf(Failing failing) {
    try {
      failing();
    } catch (const MachineError& error) {
      EXPECT_EQ(error.code(), ExitCode::kMachineFailed);
      return error.what();
    }
    return "(no MachineError)";
  }

  fs::path folder_;
};

TEST_F(FileTest, appearsOnlyOnCommit) {
  AtomicFile file(inFolder("run"));
  file.write("some ");
  file.write("bytes");
  EXPECT_FALSE(fs::exists(inFolder("run")));
  file.commit();
  EXPECT_EQ(readFile(inFolder("run")), "some bytes");
  EXPECT_EQ(entries(), 1U) << "the partial file has become the file";
}

TEST_F(FileTest, leavesNothingWithoutCommit) {
  {
    AtomicFile file(inFolder("run"));
    file.write("half");
    EXPECT_EQ(entries(), 1U) << "the partial file lies beside it";
    EXPECT_EQ(fs::directory_iterator(folder_)->path().extension(), kPartialSuffix);
  }
  EXPECT_EQ(entries(), 0U);
}

TEST_F(FileTest, keepsTheOldFileUntilCommit) {
  writeFile(inFolder("run"), "old");
  {
    AtomicFile abandoned(inFolder("run"));
    abandoned.write("new");
  }
  EXPECT_EQ(readFile(inFolder("run")), "old");
  writeFile(inFolder("run"), "new");
  EXPECT_EQ(readFile(inFolder("run")), "new");
  EXPECT_EQ(entries(), 1U);
}

TEST_F(FileTest, keepsEveryByte) {
  const std::string bytes("\0\r\n\xff\x1a", 5);
  writeFile(inFolder("bytes"), bytes);
  EXPECT_EQ(readFile(inFolder("bytes")), bytes);
  writeFile(inFolder("empty"), "");
  EXPECT_EQ(readFile(inFolder("empty")), "");
}

TEST_F(FileTest, writesIntoTheCurrentFolder) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  writeFile("bare-name", "here");
  fs::current_path(before);
  EXPECT_EQ(readFile(inFolder("bare-name")), "here");
}

TEST_F(FileTest, followsNoLinkUnderThePartialFilesName) {
  writeFile(inFolder("victim"), "precious");
  fs::create_symlink("victim", inFolder(".run." + std::to_string(getpid()) + ".partial"));
  writeFile(inFolder("run"), "bytes");
  EXPECT_EQ(readFile(inFolder("victim")), "precious");
  EXPECT_EQ(readFile(inFolder("run")), "bytes");
  EXPECT_FALSE(fs::is_symlink(inFolder("run")));
}

TEST_F(FileTest, isTheSameUnderAllItsNames) {
  writeFile(inFolder("one"), "");
  fs::create_symlink("one", inFolder("link"));
  fs::create_hard_link(inFolder("one"), inFolder("hard"));
  fs::create_directory_symlink(folder_, inFolder("folder"));
  for (const char* const name : {"one", "link", "hard", "./one", "folder/one"}) {
    EXPECT_TRUE(isSameFile(inFolder("one"), inFolder(name))) << name;
  }
  EXPECT_TRUE(isSameFile(inFolder("new"), inFolder("folder/new"))) << "neither is there yet";
  EXPECT_FALSE(isSameFile(inFolder("one"), inFolder("new")));
  EXPECT_FALSE(isSameFile(inFolder("new"), inFolder("newer")));
}

TEST_F(FileTest, thatHasNoEndIsNotRead) { EXPECT_THROW(readFile("/dev/zero"), InputError); }

// Permissions would not stop root, and root may run the tests: nobody can write into these folders.
TEST_F(FileTest, saysWhichFileCannotBeWritten) {
  const std::string missing = messageOf([&] { writeFile(inFolder("no/such/run"), "x"); });
  EXPECT_NE(missing.find("no/such/run"), std::string::npos) << missing;
  EXPECT_NE(missing.find("No such file or directory"), std::string::npos) << missing;

  writeFile(inFolder("file"), "x");
  const std::string under = messageOf([&] { writeFile(inFolder("file/run"), "x"); });
  EXPECT_NE(under.find("file/run"), std::string::npos) << under;
  EXPECT_EQ(entries(), 1U);
}

// Reached by a link, so that an error here cannot replace the device itself.
TEST_F(FileTest, writesDevicesAndPipesAsTheyAre) {
  fs::create_symlink("/dev/full", inFolder("full"));
  const std::string message = messageOf([&] { writeFile(inFolder("full"), "x"); });
  EXPECT_NE(message.find("full: cannot be written: No space left on device"), std::string::npos) << message;
  EXPECT_TRUE(fs::is_character_file(inFolder("full")));

  ASSERT_EQ(mkfifo(inFolder("pipe").c_str(), 0600), 0);
  const int end = open(inFolder("pipe").c_str(), O_RDWR | O_CLOEXEC);
  writeFile(inFolder("pipe"), "some bytes");
  std::array<char, 20> bytes{};
  EXPECT_EQ(std::string(bytes.data(), static_cast<std::size_t>(read(end, bytes.data(), bytes.size()))),
            "some bytes");
  close(end);
  EXPECT_TRUE(fs::is_fifo(inFolder("pipe")));
  EXPECT_EQ(entries(), 2U);
}

TEST_F(FileTest, writesWhatALinkNames) {
  writeFile(inFolder("run"), "old");
  fs::create_symlink("run", inFolder("link"));
  writeFile(inFolder("link"), "new");
  EXPECT_TRUE(fs::is_symlink(inFolder("link")));
  EXPECT_EQ(readFile(inFolder("run")), "new");
  fs::create_symlink("nowhere", inFolder("loose"));  // becomes the file
  writeFile(inFolder("loose"), "bytes");
  EXPECT_EQ(readFile(inFolder("loose")), "bytes");
  EXPECT_EQ(entries(), 3U);
}

TEST_F(FileTest, removesThePartialFileWhenTheNameIsTaken) {
  fs::create_directories(inFolder("taken/by/a/folder"));
  const std::string message = messageOf([&] { writeFile(inFolder("taken"), "x"); });
  EXPECT_NE(message.find("cannot be put in place"), std::string::npos) << message;
  EXPECT_EQ(entries(), 1U);
}

TEST_F(FileTest, readingWhatIsNotThereIsBadInput) {
  EXPECT_THROW(readFile(inFolder("missing")), InputError);
  EXPECT_THROW(readFile(folder_), InputError) << "a folder is not a file";
}

}  // namespace
}  // namespace careen
