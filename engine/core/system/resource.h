#pragma once

#include <filesystem>

namespace careen {

/// Folder that holds shaders/ and assets/: $CAREEN_DATA if set, else share/careen beside the bin folder of an
/// installed program, else the source tree it was built from.
std::filesystem::path resourceFolder();

/// A file or folder of resourceFolder(), such as "assets/scenes/careen.json". MachineError says where it
/// looked.
std::filesystem::path findResource(const std::filesystem::path& relative);

}  // namespace careen
