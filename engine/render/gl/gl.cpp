#include <GL/glcorearb.h>

#include "render/gl/gl.h"

#include <array>
#include <cstdio>

#include "core/error.h"

namespace careen {
namespace {

std::string text(const Gl& gl, GLenum what) {
  const GLubyte* const words = gl.GetString(what);
  return words == nullptr ? "unknown" : reinterpret_cast<const char*>(words);
}

}  // namespace

Gl::Gl(const GlContext& context) {
#define CAREEN_GL_LOAD(type, name) name = reinterpret_cast<type>(context.function("gl" #name));
  CAREEN_GL_FUNCTIONS(CAREEN_GL_LOAD)
#undef CAREEN_GL_LOAD
  description = text(*this, GL_RENDERER) + ", OpenGL " + text(*this, GL_VERSION) + ", " + context.library();
}

int Gl::integer(unsigned what) const {
  std::array<GLint, 4> values{};  // some queries return several values; the first is used
  GetIntegerv(what, values.data());
  return values[0];
}

void checkGl(const Gl& gl, const char* doing) {
  const GLenum error = gl.GetError();
  if (error == GL_NO_ERROR) {
    return;
  }
  std::array<char, 16> code{};
  std::snprintf(code.data(), code.size(), "0x%04x", error);
  const std::string what =
      error == GL_OUT_OF_MEMORY ? "out of memory" : std::string("GL error ") + code.data();
  throw MachineError(std::string(doing) + ": " + what + " (" + gl.description + ")");
}

}  // namespace careen
