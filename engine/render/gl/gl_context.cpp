#include "render/gl/gl_context.h"

namespace careen {
namespace {

// Each library tracks only its own context: it would still consider it current after another library's
// context has replaced it.
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
