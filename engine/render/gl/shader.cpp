#include <GL/glcorearb.h>

#include "render/gl/shader.h"

#include <sstream>

#include "core/error.h"
#include "core/system/resource.h"
#include "render/gl/gl.h"

namespace careen {
namespace {

constexpr GLsizei kLogBytes = 2000;
constexpr std::string_view kInclude = "#include \"";

[[noreturn]] void fail(const Gl& gl, const std::string& what, std::string log) {
  log.erase(log.find_last_not_of(std::string("\n \0", 3)) + 1);
  throw MachineError(what + ":\n" + log + "\n(" + gl.description + ")");
}

GLuint compile(const Gl& gl, const std::filesystem::path& folder, const std::string& name) {
  const std::string text = shaderText(folder, name);
  const GLuint shader = gl.CreateShader(name.ends_with(".vert") ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER);
  const GLchar* const source = text.c_str();
  gl.ShaderSource(shader, 1, &source, nullptr);
  gl.CompileShader(shader);
  GLint compiled = GL_FALSE;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_FALSE) {
    std::string log(kLogBytes, '\0');
    gl.GetShaderInfoLog(shader, kLogBytes, nullptr, log.data());
    fail(gl, (folder / name).string() + " cannot be compiled", log);
  }
  return shader;
}

std::string rawText(const std::filesystem::path& folder, const std::string& name) {
  return codeText(folder, name, embeddedShader(name));
}

}  // namespace

std::string shaderText(const std::filesystem::path& folder, const std::string& name) {
  std::istringstream lines(rawText(folder, name));
  std::string text;
  int number = 1;
  for (std::string line; std::getline(lines, line); ++number) {
    if (line.starts_with(kInclude) && line.size() > kInclude.size() + 1) {
      const std::string other = line.substr(kInclude.size(), line.size() - kInclude.size() - 1);
      text += rawText(folder, other) + "#line " + std::to_string(number + 1) + "\n";
    } else {
      text += line + "\n";
    }
  }
  return text;
}

std::vector<std::string> with(std::vector<std::string> files, const std::vector<std::string>& light) {
  files.insert(files.end(), light.begin(), light.end());
  return files;
}

unsigned linkProgram(const Gl& gl, const std::filesystem::path& folder,
                     const std::vector<std::string>& names) {
  const GLuint program = gl.CreateProgram();
  std::string list;
  for (const std::string& name : names) {
    const GLuint shader = compile(gl, folder, name);
    gl.AttachShader(program, shader);
    gl.DeleteShader(shader);  // freed with the program
    list += (list.empty() ? "" : ", ") + name;
  }
  gl.LinkProgram(program);
  GLint linked = GL_FALSE;
  gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked == GL_FALSE) {
    std::string log(kLogBytes, '\0');
    gl.GetProgramInfoLog(program, kLogBytes, nullptr, log.data());
    fail(gl, list + (folder.empty() ? "" : " in " + folder.string()) + " cannot be linked", log);
  }
  return program;
}

}  // namespace careen
