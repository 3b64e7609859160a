#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/system/cleanup.h"

namespace careen {

/// A file that appears whole or not at all: written beside its place under a hidden name, moved there by
/// commit(), removed without it; devices and pipes are written as they are. Errors are MachineError.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  AtomicFile(AtomicFile&&) = delete;
  AtomicFile& operator=(AtomicFile&&) = delete;

  void write(std::string_view bytes);
  void commit();

 private:
  void flush();
  [[noreturn]] void fail(const std::string& what) const;

  std::filesystem::path path_;
  std::filesystem::path partial_;
  int descriptor_ = -1;
  std::string pending_;
  bool committed_ = false;
  Cleanup cleanup_;
};

/// Creates a file that nobody else has made: a link or a file planted under that name is removed first and
/// never followed. Returns its descriptor, or -1 with errno.
int createNew(const std::filesystem::path& path);

/// Whether two names are of one file, through links too, whether or not it exists yet.
bool isSameFile(const std::filesystem::path& one, const std::filesystem::path& other);

/// The whole file; InputError if it is missing or cannot be read, or if it is no file on a disk and has more
/// than kMostStreamed.
std::string readFile(const std::filesystem::path& path);
void writeFile(const std::filesystem::path& path, std::string_view bytes);

inline constexpr std::size_t kMostStreamed = std::size_t{1} << 30U;  ///< [bytes] /dev/zero has no end

/// Suffix of partial files; a run that was killed leaves them behind.
inline constexpr std::string_view kPartialSuffix = ".partial";
/// Where this process writes what will be at `path`: beside it, hidden.
std::filesystem::path partialPath(const std::filesystem::path& path);

}  // namespace careen
