#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace careen::source_text {

// The project's own sources, as text.

inline const std::filesystem::path kRoot = CAREEN_SOURCE_DIR;

inline std::string textOf(const std::filesystem::path& path) {
  std::ifstream stream(path);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

inline std::vector<std::filesystem::path> sourcesIn(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> sources;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp") {
      sources.push_back(entry.path());
    }
  }
  return sources;
}

}  // namespace careen::source_text
