#pragma once

#include <optional>
#include <string>

namespace careen {

struct OsMesaOptions {
  /// Threads that fill pixels, 0: all on the calling thread; absent: Mesa's choice, one for each core. The
  /// first context of a process decides for all.
  std::optional<int> threads;
  /// Shared library to load; empty: the usual names.
  std::string library;
};

/// An OpenGL 3.3 core context that needs neither display nor GPU. The library is loaded at run time, because
/// Mesa has it no more from version 25.1 on. MachineError tells what is missing and what to install.
class OsMesa {
 public:
  explicit OsMesa(const OsMesaOptions& options);
  ~OsMesa();
  OsMesa(const OsMesa&) = delete;
  OsMesa& operator=(const OsMesa&) = delete;
  OsMesa(OsMesa&&) = delete;
  OsMesa& operator=(OsMesa&&) = delete;

  /// Further GL calls of this thread go to this context.
  void makeCurrent();
  /// Address of a GL function; MachineError if there is none of that name.
  void* function(const char* name) const;
  const std::string& library() const { return name_; }

 private:
  std::string name_;
  void* library_ = nullptr;
  void* context_ = nullptr;
  unsigned pixel_ = 0;  // a context must have some image of its own; drawing goes elsewhere
};

inline constexpr const char* kHowToGetOsMesa = "install it: apt install libosmesa6";

}  // namespace careen
