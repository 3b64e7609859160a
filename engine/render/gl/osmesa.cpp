#include <GL/glcorearb.h>

#include "render/gl/osmesa.h"

#include <array>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/system/release.h"

namespace careen {
namespace {

std::string osmesaRemedy() {
  return "what draws is installed by: apt install " + std::string(drawingPackages());
}

// The constants used from GL/osmesa.h: Mesa removed the header with the library, and this must still build
// there to draw through EGL.
enum OsmesaAttribute : int {
  kFormat = 0x22,
  kDepthBits = 0x30,
  kProfile = 0x33,
  kCoreProfile = 0x34,
  kMajorVersion = 0x36,
  kMinorVersion = 0x37
};
using CreateContext = void* (*)(const int* attributes, void* shared);
using DestroyContext = void (*)(void* context);
using MakeCurrent = GLboolean (*)(void* context, void* pixels, GLenum type, GLsizei width, GLsizei height);
using GetProcAddress = void* (*)(const char* name);

std::vector<std::string> namesOf(const std::string& library) {
  return library.empty() ? std::vector<std::string>{"libOSMesa.so.8", "libOSMesa.so"} : std::vector{library};
}

}  // namespace

OsMesa::OsMesa(const std::string& library) : library_(namesOf(library), osmesaRemedy()) {
  constexpr std::array<int, 11> kCore33 = {kFormat,       GL_RGBA, kDepthBits,    0, kProfile, kCoreProfile,
                                           kMajorVersion, 3,       kMinorVersion, 3, 0};
  context_ = library_.function<CreateContext>("OSMesaCreateContextAttribs")(kCore33.data(), nullptr);
  if (context_ == nullptr) {
    throw MachineError(library_.name() + " makes no OpenGL 3.3 core context; " + osmesaRemedy());
  }
  makeCurrent();
}

OsMesa::~OsMesa() {
  release();
  library_.function<DestroyContext>("OSMesaDestroyContext")(context_);
}

void OsMesa::bind() {
  const auto make = library_.function<MakeCurrent>("OSMesaMakeCurrent");
  if (make(context_, &pixel_, GL_UNSIGNED_BYTE, 1, 1) == GL_FALSE) {
    throw MachineError(library_.name() + " cannot use the context it made; " + osmesaRemedy());
  }
}

void OsMesa::unbind() {
  library_.function<MakeCurrent>("OSMesaMakeCurrent")(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
}

void* OsMesa::function(const char* name) const {
  void* const address = library_.function<GetProcAddress>("OSMesaGetProcAddress")(name);
  if (address == nullptr) {
    throw MachineError(library_.name() + " has no " + name + " of OpenGL 3.3; " + osmesaRemedy());
  }
  return address;
}

}  // namespace careen
