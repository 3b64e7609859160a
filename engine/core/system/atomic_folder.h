#pragma once

#include <filesystem>
#include <mutex>

#include "core/system/cleanup.h"

namespace careen {

/// A folder that appears whole or not at all: its files are written into a hidden folder beside its place,
/// moved there by commit(), and removed without commit(). A process that is killed leaves the hidden one
/// behind; its name ends with kPartialSuffix. Errors are MachineError and name the folder.
class AtomicFolder {
 public:
  explicit AtomicFolder(std::filesystem::path place);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;
  AtomicFolder(AtomicFolder&&) = delete;
  AtomicFolder& operator=(AtomicFolder&&) = delete;

  /// Where to write.
  const std::filesystem::path& path() const { return partial_; }
  /// One that is at the place already, and not empty, stays: whoever made it has made the same.
  void commit();
  /// Takes the place of the folder that is there, which is removed with all in it: at every moment one of the
  /// two is at the place, whole. (Two moves where the file system cannot exchange folders.)
  void replace();

 private:
  void remove();

  std::filesystem::path place_;
  std::filesystem::path partial_;
  bool committed_ = false;
  std::mutex mutex_;  // an interruption removes from another thread, and not what is being put in place
  bool removed_ = false;
  Cleanup cleanup_;
};

/// Removes what killed processes left in a folder: hidden files and folders whose names end with
/// kPartialSuffix. Nobody may be writing there.
void removePartials(const std::filesystem::path& folder);

}  // namespace careen
