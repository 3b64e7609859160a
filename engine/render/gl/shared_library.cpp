#include "render/gl/shared_library.h"

#include <dlfcn.h>

#include <utility>

#include "core/error.h"

namespace careen {

SharedLibrary::SharedLibrary(const std::vector<std::string>& names, std::string remedy)
    : remedy_(std::move(remedy)) {
  std::string reasons;
  for (const std::string& each : names) {
    name_ = each;
    handle_ = dlopen(each.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (handle_ != nullptr) {
      return;
    }
    reasons += std::string("; ") + dlerror();
  }
  throw MachineError(name_ + " cannot be loaded; " + remedy_ + reasons);
}

void* SharedLibrary::address(const char* name) const {
  void* const found = dlsym(handle_, name);
  if (found == nullptr) {
    throw MachineError(name_ + " has no " + name + "; " + remedy_);
  }
  return found;
}

}  // namespace careen
