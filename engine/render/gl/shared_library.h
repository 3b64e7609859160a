#pragma once

#include <string>
#include <vector>

namespace careen {

/// A library that is loaded at run time, so that a machine without it can say so, or take another. It stays
/// loaded until the process ends: its threads and its compiler's static objects may outlive any use.
class SharedLibrary {
 public:
  /// Loads the first of `names` that can be. MachineError says why none can, and `remedy`.
  SharedLibrary(const std::vector<std::string>& names, std::string remedy);

  /// A function it exports; MachineError if it has none of that name.
  template <class Function>
  Function function(const char* name) const {
    return reinterpret_cast<Function>(address(name));
  }
  /// The name it was found by.
  const std::string& name() const { return name_; }

 private:
  void* address(const char* name) const;

  std::string name_;
  std::string remedy_;
  void* handle_ = nullptr;
};

}  // namespace careen
