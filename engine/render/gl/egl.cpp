#include "render/gl/egl.h"

#define EGL_NO_PLATFORM_SPECIFIC_TYPES  // otherwise the header includes X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace careen {
namespace {

constexpr const char* kRemedy = "install it: apt install libegl1 libegl-mesa0 libgl1-mesa-dri";

struct NamedDisplay {
  std::string name;
  EGLDisplay display = EGL_NO_DISPLAY;
};

bool contains(const char* words, std::string_view word) {
  const std::string all = words == nullptr ? "" : std::string(" ") + words + " ";
  return all.find(" " + std::string(word) + " ") != std::string::npos;
}

template <class Function>
Function extension(const SharedLibrary& egl, const char* name) {
  const auto find = egl.function<PFNEGLGETPROCADDRESSPROC>("eglGetProcAddress");
  const auto found = reinterpret_cast<Function>(find(name));
  if (found == nullptr) {
    throw MachineError(egl.name() + " has no " + name + "; " + kRemedy);
  }
  return found;
}

std::string failureOf(const SharedLibrary& egl, const char* doing) {
  std::array<char, 16> code{};
  std::snprintf(code.data(), code.size(), "0x%04x",
                static_cast<unsigned>(egl.function<PFNEGLGETERRORPROC>("eglGetError")()));
  return std::string(doing) + " failed (EGL error " + code.data() + ")";
}

bool softwareAskedFor() {
  const char* const asked = std::getenv("LIBGL_ALWAYS_SOFTWARE");
  const std::string_view answer = asked == nullptr ? "" : asked;
  return answer == "1" || answer == "true" || answer == "yes" || answer == "y";
}

std::vector<NamedDisplay> gpus(const SharedLibrary& egl, const char* extensions) {
  const bool listed =
      contains(extensions, "EGL_EXT_device_base") || contains(extensions, "EGL_EXT_device_enumeration");
  if (softwareAskedFor() || !listed || !contains(extensions, "EGL_EXT_platform_device")) {
    return {};
  }
  const auto list = extension<PFNEGLQUERYDEVICESEXTPROC>(egl, "eglQueryDevicesEXT");
  const auto describe = extension<PFNEGLQUERYDEVICESTRINGEXTPROC>(egl, "eglQueryDeviceStringEXT");
  const auto displayOf = extension<PFNEGLGETPLATFORMDISPLAYEXTPROC>(egl, "eglGetPlatformDisplayEXT");
  EGLint count = 0;
  if (list(0, nullptr, &count) == EGL_FALSE || count < 1) {
    return {};
  }
  std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
  list(count, devices.data(), &count);
  devices.resize(static_cast<std::size_t>(count));
  std::vector<NamedDisplay> displays;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (!contains(describe(devices[i], EGL_EXTENSIONS), "EGL_MESA_device_software")) {
      displays.push_back({.name = "device " + std::to_string(i),
                          .display = displayOf(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr)});
    }
  }
  return displays;
}

std::vector<NamedDisplay> displaysOf(const SharedLibrary& egl) {
  const char* const extensions =
      egl.function<PFNEGLQUERYSTRINGPROC>("eglQueryString")(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  std::vector<NamedDisplay> displays = gpus(egl, extensions);
  if (contains(extensions, "EGL_MESA_platform_surfaceless")) {
    const auto displayOf = extension<PFNEGLGETPLATFORMDISPLAYEXTPROC>(egl, "eglGetPlatformDisplayEXT");
    displays.push_back(
        {.name = "surfaceless", .display = displayOf(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr)});
  }
  return displays;
}

}  // namespace

Egl::Egl(const std::string& library) : library_({library.empty() ? "libEGL.so.1" : library}, kRemedy) {
  std::string reasons;
  for (const NamedDisplay& each : displaysOf(library_)) {
    const std::string reason = open(each.display);
    if (reason.empty()) {
      return;
    }
    reasons += "; " + each.name + ": " + reason;
  }
  throw MachineError(library_.name() + " makes no OpenGL 3.3 core context; " + kRemedy +
                     (reasons.empty() ? "; it has neither a GPU nor a surfaceless platform" : reasons));
}

std::string Egl::open(void* display) {
  constexpr std::array<EGLint, 5> kAnyConfig = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                                EGL_NONE};
  constexpr std::array<EGLint, 7> kCore33 = {EGL_CONTEXT_MAJOR_VERSION,
                                             3,
                                             EGL_CONTEXT_MINOR_VERSION,
                                             3,
                                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                             EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                             EGL_NONE};
  display_ = display;
  if (library_.function<PFNEGLINITIALIZEPROC>("eglInitialize")(display, nullptr, nullptr) == EGL_FALSE) {
    return failureOf(library_, "eglInitialize");
  }
  const auto query = library_.function<PFNEGLQUERYSTRINGPROC>("eglQueryString");
  if (!contains(query(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context")) {
    return "it has no EGL_KHR_surfaceless_context";
  }
  if (library_.function<PFNEGLBINDAPIPROC>("eglBindAPI")(EGL_OPENGL_API) == EGL_FALSE) {
    return failureOf(library_, "eglBindAPI");
  }
  EGLConfig config = nullptr;
  EGLint count = 0;
  const auto choose = library_.function<PFNEGLCHOOSECONFIGPROC>("eglChooseConfig");
  if (choose(display, kAnyConfig.data(), &config, 1, &count) == EGL_FALSE || count < 1) {
    return "it has no configuration for OpenGL";
  }
  const auto create = library_.function<PFNEGLCREATECONTEXTPROC>("eglCreateContext");
  context_ = create(display, config, EGL_NO_CONTEXT, kCore33.data());
  if (context_ == EGL_NO_CONTEXT) {
    return failureOf(library_, "eglCreateContext");
  }
  try {
    makeCurrent();
  } catch (const MachineError& error) {
    library_.function<PFNEGLDESTROYCONTEXTPROC>("eglDestroyContext")(display, context_);
    return error.what();
  }
  return {};
}

Egl::~Egl() {
  release();
  library_.function<PFNEGLDESTROYCONTEXTPROC>("eglDestroyContext")(display_, context_);
}

void Egl::bind() {
  const auto make = library_.function<PFNEGLMAKECURRENTPROC>("eglMakeCurrent");
  if (make(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) {
    throw MachineError(failureOf(library_, "eglMakeCurrent"));
  }
}

void Egl::unbind() {
  const auto make = library_.function<PFNEGLMAKECURRENTPROC>("eglMakeCurrent");
  make(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

void* Egl::function(const char* name) const { return extension<void*>(library_, name); }

}  // namespace careen
