#include "render/gl/gl_context.h"

namespace careen {
namespace {

// Each library remembers only its own context: it would take one for current that another's has replaced.
thread_local GlContext* current = nullptr;

}  // namespace

void GlContext::makeCurrent() {
  if (current == this) {
    return;
  }
  if (current != nullptr) {
    current->release();
  }
  bind();
  current = this;
}

void GlContext::release() {
  if (current == this) {
    current = nullptr;
    unbind();
  }
}

}  // namespace careen
