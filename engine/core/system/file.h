#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace careen {

/// A file that appears whole or not at all: written beside its place under a hidden name, moved there by
/// commit(), removed if commit() is never reached. Errors are MachineError and name the file.
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
};

/// The whole file; InputError if it is missing or cannot be read.
std::string readFile(const std::filesystem::path& path);
void writeFile(const std::filesystem::path& path, std::string_view bytes);

/// Files left by a run that was killed outright are told by this ending.
inline constexpr std::string_view kPartialEnding = ".partial";

}  // namespace careen
