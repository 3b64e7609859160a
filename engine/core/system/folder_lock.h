#pragma once

#include <filesystem>
#include <optional>

#include "core/system/cleanup.h"

namespace careen {

/// Who else may hold a folder's lock at the same time: nobody, or others that share it.
enum class LockKind { kExclusive, kShared };

/// Locks a folder for this process for the object's lifetime; the system releases the lock when the process
/// and its forks end, however they end. Works across machines if the file system supports such locks, as NFS
/// should (not tried). Without any lock support, two processes in one folder go undetected.
class FolderLock {
 public:
  /// Creates a hidden lock file in the folder, removed by the destructor of the last holder. InputError if
  /// another process holds a lock that excludes this one for more than a second: workers of a killed process
  /// take a moment to end.
  explicit FolderLock(const std::filesystem::path& folder, LockKind kind = LockKind::kExclusive);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  FolderLock(FolderLock&&) = delete;
  FolderLock& operator=(FolderLock&&) = delete;

  /// Name of the lock file.
  static constexpr const char* kFileName = ".careen.lock";

 private:
  void removeFile() const;

  std::filesystem::path file_;
  LockKind kind_;
  int descriptor_ = -1;  ///< −1: locks are not supported
  std::optional<Cleanup> cleanup_;
};

}  // namespace careen
