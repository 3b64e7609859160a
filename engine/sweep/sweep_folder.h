#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/system/cleanup.h"
#include "core/system/folder_lock.h"

namespace careen {

/// How a sweep takes its folder.
enum class SweepOpening {
  kAnew,     ///< an earlier sweep there is removed
  kResumed,  ///< what the same sweep left there is kept
  kShared,   ///< likewise, beside other shares of the same sweep
};

/// A sweep's folder, created if it does not exist and locked against other processes: sweep.json says what it
/// is of, `rows` holds blocks of rows while the sweep works, `runs` the files of single runs, and table.csv
/// and table.npz are the end. Unless others share it, the destructor removes partial files, also those that
/// killed processes left, and all that nothing was written into.
class SweepFolder {
 public:
  /// `manifest` is the text of sweep.json, an object of JSON whose values are texts. InputError if the folder
  /// is of something else, or if another process has locked it; MachineError if it cannot be created.
  SweepFolder(std::filesystem::path path, const std::string& manifest, SweepOpening opening);
  ~SweepFolder();
  SweepFolder(const SweepFolder&) = delete;
  SweepFolder& operator=(const SweepFolder&) = delete;
  SweepFolder(SweepFolder&&) = delete;
  SweepFolder& operator=(SweepFolder&&) = delete;

  /// Whether the folder holds the table of the sweep with this manifest.
  static bool isFinished(const std::filesystem::path& path, const std::string& manifest);

  std::filesystem::path rows() const { return path_ / "rows"; }
  std::filesystem::path runs() const { return path_ / "runs"; }
  std::filesystem::path table(const char* suffix) const { return path_ / (std::string("table") + suffix); }

 private:
  void open(const std::string& manifest);
  void refuseAnother(const std::string& manifest) const;
  void removeEarlier() const;
  void tidy() const;
  void removeIfEmpty() const;

  std::filesystem::path path_;
  SweepOpening opening_;
  bool made_ = false;
  std::optional<Cleanup> cleanup_;  // before the lock: its file goes first
  std::optional<FolderLock> lock_;
};

}  // namespace careen
