#pragma once

#include "render/gl/gl_context.h"
#include "render/gl/shared_library.h"

namespace careen {

/// Mesa's off-screen library: draws on the CPU and has no other requirements. Removed from Mesa in version
/// 25.1.
class OsMesa final : public GlContext {
 public:
  /// Loads `library`, or the default one if empty. MachineError says what is missing and what to install.
  explicit OsMesa(const std::string& library);
  ~OsMesa() override;
  OsMesa(const OsMesa&) = delete;
  OsMesa& operator=(const OsMesa&) = delete;
  OsMesa(OsMesa&&) = delete;
  OsMesa& operator=(OsMesa&&) = delete;

  void* function(const char* name) const override;
  const std::string& library() const override { return library_.name(); }

 private:
  void bind() override;
  void unbind() override;

  SharedLibrary library_;
  void* context_ = nullptr;
  unsigned pixel_ = 0;  // a context needs an image of its own; drawing goes to a framebuffer
};

}  // namespace careen
