#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/gl/gl_context.h"

namespace careen {

/// Ways to create an OpenGL context. kAuto is the first of the others that is available.
enum class RenderingBackend { kAuto, kOsMesa, kEgl };

/// Names on the command line, in the order of the enum; the same as F3D's.
inline constexpr std::array<std::string_view, 3> kRenderingBackends = {"auto", "osmesa", "egl"};

/// InputError, listing the valid names, for an unknown name.
RenderingBackend renderingBackendNamed(std::string_view name);

inline constexpr int kMostThreads = 64;

struct ContextOptions {
  RenderingBackend backend = RenderingBackend::kAuto;
  /// Number of rasterizer threads where Mesa draws on the CPU, at most kMostThreads; 0: only the calling
  /// thread; absent: Mesa's default, one per core. The first context of a process decides for all of the same
  /// library.
  std::optional<int> threads;
  std::string osMesaLibrary;  ///< shared library to load; empty: the default one
  std::string eglLibrary;     ///< likewise
};

/// Opens a context and makes it current. MachineError says for each library tried what is missing and what to
/// install.
std::unique_ptr<GlContext> openContext(const ContextOptions& options);

/// Whether this process has requested a context before. GL's threads do not survive a fork.
bool glWasOpened();

struct BackendFound {
  std::string_view name;
  bool available = false;
  std::string description;  ///< the renderer, such as "llvmpipe (…), OpenGL …"; or why there is none
};

/// Tries every backend, in the order of kAuto, by opening a context of each; options.backend is ignored.
std::vector<BackendFound> findRenderingBackends(const ContextOptions& options);

}  // namespace careen
