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

/// Frames of the manifest that are missing, corrupt, of another size or, where it has their hash, of other
/// bytes than were drawn. Reads every file completely.
std::vector<FrameFault> findFaults(const std::filesystem::path& folder, const FilmManifest& manifest);

}  // namespace careen
