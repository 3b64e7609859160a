#pragma once

#include "render/gl/gl_context.h"
#include "render/gl/shared_library.h"

namespace careen {

/// EGL without any surface. Tried in this order, the first that makes a context is taken:
/// 1. GPUs, in EGL's own order (EGL_EXT_platform_device, the only way to those with a driver that is not
/// Mesa's);
///    left out if LIBGL_ALWAYS_SOFTWARE=1, which Mesa has for the same purpose;
/// 2. Mesa's surfaceless platform: llvmpipe, on the processor, to the same pixels as OsMesa of the same
/// version.
class Egl final : public GlContext {
 public:
  /// Loads `library`, if empty the usual one. MachineError tells what is missing and what to install.
  explicit Egl(const std::string& library);
  ~Egl() override;
  Egl(const Egl&) = delete;
  Egl& operator=(const Egl&) = delete;
  Egl(Egl&&) = delete;
  Egl& operator=(Egl&&) = delete;

  void* function(const char* name) const override;
  const std::string& library() const override { return library_.name(); }

 private:
  /// Why a display makes no context that can be used; empty if it does.
  std::string open(void* display);
  void bind() override;
  void unbind() override;

  SharedLibrary library_;
  void* display_ = nullptr;  // the process's, shared by all contexts: never terminated
  void* context_ = nullptr;
};

}  // namespace careen
