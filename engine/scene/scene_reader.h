#pragma once

#include <filesystem>
#include <string>

#include "scene/scene.h"
#include "scene/starts.h"

namespace careen {

/// Reads and checks a scene. InputError says "file:line:column: what was found, what was expected".
Scene readScene(const std::filesystem::path& path);
/// The same from text; `name` is the file's name in messages. If boxes may overlap, the caller must move
/// them apart.
Scene parseScene(const std::string& text, const std::string& name, Starts starts = Starts::kApart);

}  // namespace careen
