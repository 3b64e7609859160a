#include "render/osmesa.h"

#include <GL/osmesa.h>
#include <dlfcn.h>

#include <array>
#include <cstdlib>
#include <string_view>

#include "core/error.h"

namespace careen {
namespace {

constexpr int kMostThreads = 64;

// Read by the library when it makes its first context.
void prepareEnvironment(const OsMesaOptions& options) {
  if (options.threads) {
    if (*options.threads < 0 || *options.threads > kMostThreads) {
      throw InputError("threads: found " + std::to_string(*options.threads) + ", expected 0 to " +
                       std::to_string(kMostThreads));
    }
    setenv("LP_NUM_THREADS", std::to_string(*options.threads).c_str(), 1);
  }
  // Code for vectors of 512 bits crashes in Mesa 22.3; those of 256 give the same pixels.
  const char* const width = std::getenv("LP_NATIVE_VECTOR_WIDTH");
  if (width != nullptr && std::atoi(width) > 256) {
    setenv("LP_NATIVE_VECTOR_WIDTH", "256", 1);
  }
}

// Never closed again: its threads and its compiler's static objects may outlive any context.
void* openLibrary(const std::string& asked, std::string& name) {
  const std::array<std::string, 2> usual = {"libOSMesa.so.8", "libOSMesa.so"};
  std::string reasons;
  for (const std::string& each : usual) {
    name = asked.empty() ? each : asked;
    if (void* library = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE)) {
      return library;
    }
    reasons += std::string("; ") + dlerror();
    if (!asked.empty()) {
      break;
    }
  }
  throw MachineError(name + ", which draws the frames, cannot be loaded; " + kHowToGetOsMesa + reasons);
}

template <class Function>
Function symbol(void* library, const std::string& libraryName, const char* name) {
  void* address = dlsym(library, name);
  if (address == nullptr) {
    throw MachineError(libraryName + " has no " + name + "; " + kHowToGetOsMesa);
  }
  return reinterpret_cast<Function>(address);
}

}  // namespace

OsMesa::OsMesa(const OsMesaOptions& options) {
  prepareEnvironment(options);
  library_ = openLibrary(options.library, name_);
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
  context_ = symbol<decltype(&OSMesaCreateContextAttribs)>(library_, name_, "OSMesaCreateContextAttribs")(
      attributes.data(), nullptr);
  if (context_ == nullptr) {
    throw MachineError(name_ + " makes no OpenGL 3.3 core context; " + kHowToGetOsMesa);
  }
  makeCurrent();
}

OsMesa::~OsMesa() {
  symbol<decltype(&OSMesaDestroyContext)>(library_, name_,
                                          "OSMesaDestroyContext")(static_cast<OSMesaContext>(context_));
}

void OsMesa::makeCurrent() {
  const auto make = symbol<decltype(&OSMesaMakeCurrent)>(library_, name_, "OSMesaMakeCurrent");
  if (make(static_cast<OSMesaContext>(context_), &pixel_, GL_UNSIGNED_BYTE, 1, 1) == GL_FALSE) {
    throw MachineError(name_ + " cannot use the context it made; " + kHowToGetOsMesa);
  }
}

void* OsMesa::function(const char* name) const {
  const auto find = symbol<decltype(&OSMesaGetProcAddress)>(library_, name_, "OSMesaGetProcAddress");
  void* address = reinterpret_cast<void*>(find(name));
  if (address == nullptr) {
    throw MachineError(name_ + " has no " + name + " of OpenGL 3.3; " + kHowToGetOsMesa);
  }
  return address;
}

}  // namespace careen
