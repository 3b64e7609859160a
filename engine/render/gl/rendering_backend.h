#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/gl/gl_context.h"

namespace careen {

/// Ways to an OpenGL context. kAuto is the first of the others that there is.
enum class RenderingBackend { kAuto, kOsMesa, kEgl };

/// In their order, as commands spell them; F3D has the same.
inline constexpr std::array<std::string_view, 3> kRenderingBackends = {"auto", "osmesa", "egl"};

/// InputError, naming those there are, for a name that none has.
RenderingBackend renderingBackendNamed(std::string_view name);

inline constexpr int kMostThreads = 64;

struct ContextOptions {
  RenderingBackend backend = RenderingBackend::kAuto;
  /// At most kMostThreads threads that fill pixels where Mesa draws on the processor, 0: all on the calling
  /// thread; absent: Mesa's choice, one for each core. The first context of a process decides for all of the
  /// same library.
  std::optional<int> threads;
  std::string osMesaLibrary;  ///< shared library to load; empty: the usual one
  std::string eglLibrary;     ///< likewise
};

/// Opens a context and makes it current. MachineError tells what is missing and what to install, of each
/// library that was tried.
std::unique_ptr<GlContext> openContext(const ContextOptions& options);

/// Whether this process has asked for a context before. GL's threads are not forked with it.
bool glWasOpened();

struct BackendFound {
  std::string_view name;
  bool available = false;
  std::string description;  ///< who draws, such as "llvmpipe (…), OpenGL …"; or why nobody does
};

/// Tries every backend, in the order of kAuto, by opening a context of each; options.backend does not matter.
std::vector<BackendFound> findRenderingBackends(const ContextOptions& options);

}  // namespace careen
