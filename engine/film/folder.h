#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/system/cleanup.h"
#include "core/system/folder_lock.h"
#include "film/manifest.h"

namespace careen {

/// File name of a frame: 000000.png for frame 0.
std::string frameFileName(std::int64_t frame);

/// Whether the folder holds what a comparison with another film left there (compare/report.h).
bool holdsComparison(const std::filesystem::path& folder);

/// A folder that a film is being written to: created if it does not exist, locked against other processes,
/// and removed again if nothing was written. Only files that careen wrote are ever removed; partial files of
/// processes that died are removed by the destructor.
class FilmFolder {
 public:
  /// MachineError if the folder cannot be created, InputError if another process has locked it or it contains
  /// PNG files but no manifest.
  explicit FilmFolder(std::filesystem::path path);
  ~FilmFolder();
  FilmFolder(const FilmFolder&) = delete;
  FilmFolder& operator=(const FilmFolder&) = delete;
  FilmFolder(FilmFolder&&) = delete;
  FilmFolder& operator=(FilmFolder&&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// The film already in the folder.
  const std::optional<FilmManifest>& manifest() const { return manifest_; }

  /// The requested frames that are missing, incomplete or other than the manifest there says.
  std::vector<std::int64_t> missing(const FilmManifest& asked) const;
  /// Prepares the folder for a film: with `keep`, the frames of the film there stay and count as its own;
  /// otherwise those that its manifest lists are removed. A report of an earlier comparison, which says
  /// nothing of this film, is removed, and nothing else.
  void begin(const FilmManifest& asked, bool keep);
  /// Adds hashes of frames that were drawn to the manifest, and of whole frames there that have none; begin()
  /// has been called.
  void keep(const std::map<std::int64_t, std::string>& hashes);

 private:
  void removePartials() const;
  void removeIfEmpty() const;
  bool isAsDrawn(const std::filesystem::path& path, std::int64_t frame) const;

  std::filesystem::path path_;
  bool made_ = false;
  std::optional<Cleanup> cleanup_;  // before the lock: its file goes first
  std::optional<FolderLock> lock_;
  std::optional<FilmManifest> manifest_;
};

}  // namespace careen
