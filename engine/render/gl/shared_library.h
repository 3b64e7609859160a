#pragma once

#include <string>
#include <vector>

namespace careen {

/// A library loaded at run time, so that a machine without it can report that or use another. It stays loaded
/// until the process ends: its threads and its compiler's static objects may outlive any use.
class SharedLibrary {
 public:
  /// Loads the first of `names` that can be loaded. MachineError says why each failed, and `remedy`.
  SharedLibrary(const std::vector<std::string>& names, std::string remedy);

  /// An exported function; MachineError if there is none of that name.
  template <class Function>
  Function function(const char* name) const {
    return reinterpret_cast<Function>(address(name));
  }
  /// The name it was loaded by.
  const std::string& name() const { return name_; }

 private:
  void* address(const char* name) const;

  std::string name_;
  std::string remedy_;
  void* handle_ = nullptr;
};

}  // namespace careen
