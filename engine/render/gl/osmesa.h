#pragma once

#include "render/gl/gl_context.h"
#include "render/gl/shared_library.h"

namespace careen {

/// Mesa's off-screen library: draws on the processor, needs nothing else of the machine. Mesa has it no more
/// from version 25.1 on.
class OsMesa final : public GlContext {
 public:
  /// Loads `library`, if empty the usual one. MachineError tells what is missing and what to install.
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
  unsigned pixel_ = 0;  // a context must have some image of its own; drawing goes elsewhere
};

}  // namespace careen
