#pragma once

#include <string>

namespace careen {

/// An OpenGL 3.3 core context. Except for a window's context it has no display, and the caller provides the
/// framebuffer. Created, used and destroyed on one thread. Several contexts, of several libraries, may exist.
class GlContext {
 public:
  GlContext() = default;
  virtual ~GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;
  GlContext(GlContext&&) = delete;
  GlContext& operator=(GlContext&&) = delete;

  /// Makes this context current on this thread; MachineError if that fails.
  void makeCurrent();
  /// Address of a GL function; MachineError if it does not exist.
  virtual void* function(const char* name) const = 0;
  /// Name of the library that provides it.
  virtual const std::string& library() const = 0;

 protected:
  /// For destructors: unbinds this context if it is current.
  void release();

 private:
  virtual void bind() = 0;
  virtual void unbind() = 0;
};

}  // namespace careen
