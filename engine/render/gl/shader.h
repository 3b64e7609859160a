#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace careen {

struct Gl;

/// Text of a shader file as it was when the program was built; empty if there was none of that name.
std::string_view embeddedShader(std::string_view name);

/// Text of a shader: the file in `folder` if it is there, else the embedded one, with other files in place of
/// lines that say #include "other". MachineError if there is neither.
std::string shaderText(const std::filesystem::path& folder, const std::string& name);

/// The files of a program: its own, then those that light it.
std::vector<std::string> with(std::vector<std::string> files, const std::vector<std::string>& light);

/// Compiles and links a program from files of one stage each, told by their endings .vert and .frag; one
/// stage may be made of several. MachineError names the file and says what the compiler said.
unsigned linkProgram(const Gl& gl, const std::filesystem::path& folder,
                     const std::vector<std::string>& names);

}  // namespace careen
