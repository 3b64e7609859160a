#pragma once

#include <filesystem>
#include <string>

#include "support/process.h"

namespace careen {

/// A copy of a program as bin/careen, and a folder share/careen beside it in which anybody may have put
/// files.
class CopiedProgram {
 public:
  explicit CopiedProgram(const std::filesystem::path& program) {
    std::filesystem::create_directories(folder_ / "bin");
    std::filesystem::create_directories(data());
    std::filesystem::copy_file(program, folder_ / "bin/careen");
  }

  std::filesystem::path path() const { return folder_ / "bin/careen"; }
  std::filesystem::path data() const { return folder_ / "share/careen"; }
  /// Writes a file of data(), such as "shaders/box.frag".
  void plant(const std::filesystem::path& file, const std::string& text) const {
    std::filesystem::create_directories((data() / file).parent_path());
    folder_.write(("share/careen" / file).string(), text);
  }
  /// A copy of a folder of the source tree, such as "assets/plots", there.
  void plantAll(const std::filesystem::path& folder) const {
    std::filesystem::create_directories(data() / folder);
    std::filesystem::copy(CAREEN_SOURCE_DIR / folder, data() / folder);
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace careen
