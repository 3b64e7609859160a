#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "film/folder_lock.h"
#include "film/manifest.h"

namespace careen {

/// Name of a frame's file: 000000.png for frame 0.
std::string frameFileName(std::int64_t frame);

/// A folder that a film is being written into: made if it is not there, held so that no other process writes
/// to it, and gone again if nothing was written. Only what careen wrote is ever removed; what was being
/// written when a process died goes with this object.
class FilmFolder {
 public:
  /// MachineError if the folder cannot be made, InputError if another process holds it or if it has PNG files
  /// that no manifest tells of.
  explicit FilmFolder(std::filesystem::path path);
  ~FilmFolder();
  FilmFolder(const FilmFolder&) = delete;
  FilmFolder& operator=(const FilmFolder&) = delete;
  FilmFolder(FilmFolder&&) = delete;
  FilmFolder& operator=(FilmFolder&&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// What film is there.
  const std::optional<FilmManifest>& manifest() const { return manifest_; }

  /// Of the frames asked for, those not there or not whole.
  std::vector<std::int64_t> missing(const FilmManifest& asked) const;
  /// Makes place for a film: another film's frames go, the same film's stay.
  void begin(const FilmManifest& asked, bool resume);

 private:
  std::filesystem::path path_;
  bool made_ = false;
  std::optional<FolderLock> lock_;
  std::optional<FilmManifest> manifest_;
};

}  // namespace careen
