#pragma once

#include <filesystem>

namespace careen {

/// Keeps a folder to this process for as long as the object is there; the system gives it up when the process
/// and those it forked end, however they end. Holds between machines too, where the file system has locks
/// between them, as NFS should (not tried). Where there are none at all, two processes in one folder go
/// unnoticed.
class FolderLock {
 public:
  /// Makes a hidden file in the folder, which goes with this object. InputError if another process holds the
  /// folder for more than a second: workers of one that was killed take a moment to end.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  FolderLock(FolderLock&&) = delete;
  FolderLock& operator=(FolderLock&&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;  ///< −1: no locks here
};

}  // namespace careen
