#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "film/manifest.h"

namespace careen {

struct FrameFault {
  std::int64_t frame = 0;
  std::string what;  ///< "is missing", …
};

/// Frames of the manifest that are missing, corrupt or of another size. Reads every file completely.
std::vector<FrameFault> findFaults(const std::filesystem::path& folder, const FilmManifest& manifest);

}  // namespace careen
