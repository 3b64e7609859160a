#include "core/system/scratch_folder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "core/error.h"
#include "core/system/file.h"
#include "support/environment_variable.h"

namespace careen {
namespace {

namespace fs = std::filesystem;

TEST(ScratchFolder, isOfThisUserAloneAndGoesWithWhatIsInIt) {
  fs::path path;
  {
    const ScratchFolder scratch;
    path = scratch.path();
    struct stat status {};
    ASSERT_EQ(stat(path.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0700U);
    writeFile(scratch / "file", "x");
    fs::create_directories(path / "a/b");
  }
  EXPECT_FALSE(fs::exists(path));
}

TEST(ScratchFolder, isAnotherOneEachTime) {
  const ScratchFolder one;
  const ScratchFolder other;
  EXPECT_NE(one.path(), other.path());
}

TEST(ScratchFolder, saysThatThereIsNoPlaceForOne) {
  const EnvironmentVariable folder("TMPDIR", "/no/such/folder");
  EXPECT_THROW(ScratchFolder(), MachineError);
}

}  // namespace
}  // namespace careen
