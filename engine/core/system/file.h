#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "core/system/cleanup.h"

namespace careen {

/// A file that appears whole or not at all: it is written beside its place under a hidden name, moved there
/// by commit(), and removed without commit(). Errors are MachineError and name the file.
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
  [[noreturn]] void fail(const std::string& what) const;

  std::filesystem::path path_;
  std::filesystem::path partial_;
  std::ofstream stream_;
  bool committed_ = false;
  Cleanup cleanup_;
};

/// The whole file; InputError if it is missing or cannot be read.
std::string readFile(const std::filesystem::path& path);
void writeFile(const std::filesystem::path& path, std::string_view bytes);

/// Suffix of partial files; a run that was killed leaves them behind.
inline constexpr std::string_view kPartialSuffix = ".partial";

}  // namespace careen
