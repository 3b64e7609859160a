#pragma once

#include <filesystem>
#include <optional>

#include "core/system/cleanup.h"

namespace careen {

/// Locks a folder for this process for the object's lifetime; the system releases the lock when the process
/// and its forks end, however they end. Works across machines if the file system supports such locks, as NFS
/// should (not tried). Without any lock support, two processes in one folder go undetected.
class FolderLock {
 public:
  /// Creates a hidden lock file in the folder, removed by the destructor. InputError if another process holds
  /// the lock for more than a second: workers of a killed process take a moment to end.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  FolderLock(FolderLock&&) = delete;
  FolderLock& operator=(FolderLock&&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;  ///< −1: locks are not supported
  std::optional<Cleanup> cleanup_;
};

}  // namespace careen
