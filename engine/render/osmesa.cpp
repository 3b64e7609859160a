#include "render/osmesa.h"

#include <GL/osmesa.h>

#include <array>
#include <vector>

#include "core/error.h"

namespace careen {
namespace {

constexpr const char* kRemedy = "install it: apt install libosmesa6";

std::vector<std::string> namesOf(const std::string& library) {
  return library.empty() ? std::vector<std::string>{"libOSMesa.so.8", "libOSMesa.so"} : std::vector{library};
}

}  // namespace

OsMesa::OsMesa(const std::string& library) : library_(namesOf(library), kRemedy) {
  const std::array<int, 13> attributes = {OSMESA_FORMAT,
                                          OSMESA_RGBA,
                                          OSMESA_DEPTH_BITS,
                                          0,
                                          OSMESA_PROFILE,
                                          OSMESA_CORE_PROFILE,
                                          OSMESA_CONTEXT_MAJOR_VERSION,
                                          3,
                                          OSMESA_CONTEXT_MINOR_VERSION,
                                          3,
                                          0};
  context_ = library_.function<decltype(&OSMesaCreateContextAttribs)>("OSMesaCreateContextAttribs")(
      attributes.data(), nullptr);
  if (context_ == nullptr) {
    throw MachineError(library_.name() + " makes no OpenGL 3.3 core context; " + kRemedy);
  }
  makeCurrent();
}

OsMesa::~OsMesa() {
  release();
  library_.function<decltype(&OSMesaDestroyContext)>("OSMesaDestroyContext")(
      static_cast<OSMesaContext>(context_));
}

void OsMesa::bind() {
  const auto make = library_.function<decltype(&OSMesaMakeCurrent)>("OSMesaMakeCurrent");
  if (make(static_cast<OSMesaContext>(context_), &pixel_, GL_UNSIGNED_BYTE, 1, 1) == GL_FALSE) {
    throw MachineError(library_.name() + " cannot use the context it made; " + kRemedy);
  }
}

void OsMesa::unbind() {
  library_.function<decltype(&OSMesaMakeCurrent)>("OSMesaMakeCurrent")(nullptr, nullptr, GL_UNSIGNED_BYTE, 0,
                                                                       0);
}

void* OsMesa::function(const char* name) const {
  const auto find = library_.function<decltype(&OSMesaGetProcAddress)>("OSMesaGetProcAddress");
  void* address = reinterpret_cast<void*>(find(name));
  if (address == nullptr) {
    throw MachineError(library_.name() + " has no " + name + " of OpenGL 3.3; " + kRemedy);
  }
  return address;
}

}  // namespace careen
