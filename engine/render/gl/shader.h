#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace careen {

struct Gl;

/// Text of a shader file as embedded at build time; empty if there is none of that name.
std::string_view embeddedShader(std::string_view name);

/// Text of a shader: the file in `folder` if it exists, else the embedded one, with lines #include "other"
/// replaced by that file. An empty `folder` is none. MachineError if there is neither.
std::string shaderText(const std::filesystem::path& folder, const std::string& name);

/// The files of a program: its own, then the lighting shaders.
std::vector<std::string> with(std::vector<std::string> files, const std::vector<std::string>& light);

/// Compiles and links a program. Each file belongs to one stage, given by its extension .vert or .frag; a
/// stage may have several files. MachineError names the file and includes the compiler's message.
unsigned linkProgram(const Gl& gl, const std::filesystem::path& folder,
                     const std::vector<std::string>& names);

}  // namespace careen
