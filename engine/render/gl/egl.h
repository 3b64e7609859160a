#pragma once

#include "render/gl/gl_context.h"
#include "render/gl/shared_library.h"

namespace careen {

/// EGL without a surface. Displays are tried in order; the first that creates a context is used: (1) GPUs in
/// EGL's order (EGL_EXT_platform_device, the only way to reach non-Mesa drivers), skipped if
/// LIBGL_ALWAYS_SOFTWARE=1, Mesa's variable for the same purpose; (2) Mesa's surfaceless platform: llvmpipe
/// on the CPU, with the same pixels as OsMesa of the same version.
class Egl final : public GlContext {
 public:
  /// Loads `library`, or the default one if empty. MachineError says what is missing and what to install.
  explicit Egl(const std::string& library);
  ~Egl() override;
  Egl(const Egl&) = delete;
  Egl& operator=(const Egl&) = delete;
  Egl(Egl&&) = delete;
  Egl& operator=(Egl&&) = delete;

  void* function(const char* name) const override;
  const std::string& library() const override { return library_.name(); }

 private:
  /// Returns why a display cannot create a usable context; empty on success.
  std::string open(void* display);
  void bind() override;
  void unbind() override;

  SharedLibrary library_;
  void* display_ = nullptr;  // shared by all contexts of the process: never terminated
  void* context_ = nullptr;
};

}  // namespace careen
