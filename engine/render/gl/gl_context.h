#pragma once

#include <string>

namespace careen {

/// An OpenGL 3.3 core context. But for a window's it is without display, and whoever draws brings a
/// framebuffer of their own. Made, used and destroyed on one thread. There may be several, of several
/// libraries.
class GlContext {
 public:
  GlContext() = default;
  virtual ~GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;
  GlContext(GlContext&&) = delete;
  GlContext& operator=(GlContext&&) = delete;

  /// Further GL calls of this thread go to this context; MachineError if that cannot be.
  void makeCurrent();
  /// Address of a GL function; MachineError if there is none of that name.
  virtual void* function(const char* name) const = 0;
  /// Name of the library it comes from.
  virtual const std::string& library() const = 0;

 protected:
  /// For destructors: no context is current any more if this one was.
  void release();

 private:
  virtual void bind() = 0;
  virtual void unbind() = 0;
};

}  // namespace careen
