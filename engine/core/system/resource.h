#pragma once

#include <filesystem>
#include <string>
#include <string_view>

// Files that the program comes with.
//
// Data (scenes, truths, the list of cases) is read from disk: from $CAREEN_DATA if set, else from
// share/careen beside the bin folder of an installed program, else from the source tree it was built from.
//
// Code (shaders, scripts of plots, pages and their scripts) is built into the program, and read from disk
// only where the user asks for it by $CAREEN_DATA: who can write beside a program must not choose what it
// runs.
namespace careen {

/// A file or folder of data, such as "assets/scenes/careen.json". MachineError says where it looked.
std::filesystem::path findResource(const std::filesystem::path& relative);

/// $CAREEN_DATA, where code may be read from; empty if unset. MachineError if it is not a folder.
std::filesystem::path codeFolder();

/// Text of a file of code: the file in `folder` if it exists, else `builtIn`. An empty `folder` is none.
/// MachineError if there is neither, or if the file cannot be read.
std::string codeText(const std::filesystem::path& folder, const std::filesystem::path& relative,
                     std::string_view builtIn);

}  // namespace careen
