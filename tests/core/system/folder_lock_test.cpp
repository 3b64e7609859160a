#include "core/system/folder_lock.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/error.h"
#include "support/process.h"

namespace careen {
namespace {

TEST(FolderLock, isOneHoldersAtATime) {
  const TemporaryFolder folder;
  std::optional<FolderLock> held(folder.path());
  EXPECT_THROW(FolderLock second(folder.path()), InputError);
  EXPECT_TRUE(std::filesystem::exists(folder / ".careen.lock"));  // who is refused takes nothing away
  held.reset();
  EXPECT_NO_THROW(FolderLock next(folder.path()));
}

TEST(FolderLock, isWaitedForAMoment) {
  const TemporaryFolder folder;
  std::optional<FolderLock> held(folder.path());
  std::jthread holder([&held] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    held.reset();
  });
  EXPECT_NO_THROW(FolderLock next(folder.path()));
}

TEST(FolderLock, sharedOnesExcludeOnlyExclusiveOnes) {
  const TemporaryFolder folder;
  std::optional<FolderLock> one(std::in_place, folder.path(), LockKind::kShared);
  std::optional<FolderLock> other(std::in_place, folder.path(), LockKind::kShared);
  EXPECT_THROW(FolderLock alone(folder.path()), InputError);
  one.reset();
  EXPECT_TRUE(std::filesystem::exists(folder / ".careen.lock")) << "the other one still holds it";
  EXPECT_THROW(FolderLock alone(folder.path()), InputError);
  other.reset();
  EXPECT_EQ(folder.files(), std::vector<std::string>());
  const FolderLock alone(folder.path());
  EXPECT_THROW(FolderLock third(folder.path(), LockKind::kShared), InputError);
}

TEST(FolderLock, leavesNothing) {
  const TemporaryFolder folder;
  { const FolderLock held(folder.path()); }
  EXPECT_EQ(folder.files(), std::vector<std::string>());
}

TEST(FolderLock, whatAKilledProcessLeftIsNoObstacle) {
  const TemporaryFolder folder;
  folder.write(".careen.lock", "");
  EXPECT_NO_THROW(FolderLock held(folder.path()));
  EXPECT_EQ(folder.files(), std::vector<std::string>());
}

}  // namespace
}  // namespace careen
