#pragma once

#include <filesystem>

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

 private:
  void remove() const;

  std::filesystem::path place_;
  std::filesystem::path partial_;
  bool committed_ = false;
  Cleanup cleanup_;
};

/// Removes what killed processes left in a folder: hidden files and folders whose names end with
/// kPartialSuffix. Nobody may be writing there.
void removePartials(const std::filesystem::path& folder);

}  // namespace careen
