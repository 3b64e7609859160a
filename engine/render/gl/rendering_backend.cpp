#include <GL/glcorearb.h>

#include "render/gl/rendering_backend.h"

#include <cstdlib>

#include "core/error.h"
#include "core/names.h"
#include "render/gl/egl.h"
#include "render/gl/gl.h"
#include "render/gl/osmesa.h"

namespace careen {
namespace {

bool opened = false;

constexpr std::array kSingle = {RenderingBackend::kOsMesa, RenderingBackend::kEgl};

std::string_view nameOf(RenderingBackend backend) {
  return kRenderingBackends.at(static_cast<std::size_t>(backend));
}

// Mesa reads these variables when one of its libraries creates the first context.
void prepareEnvironment(const std::optional<int>& threads) {
  if (threads) {
    if (*threads < 0 || *threads > kMostThreads) {
      throw InputError("threads: found " + std::to_string(*threads) + ", expected 0 to " +
                       std::to_string(kMostThreads));
    }
    setenv("LP_NUM_THREADS", std::to_string(*threads).c_str(), 1);
  }
  // 512-bit vector code crashes in Mesa 22.3; 256-bit vectors give the same pixels.
  const char* const width = std::getenv("LP_NATIVE_VECTOR_WIDTH");
  if (width != nullptr && std::atoi(width) > 256) {
    setenv("LP_NATIVE_VECTOR_WIDTH", "256", 1);
  }
}

std::unique_ptr<GlContext> open(RenderingBackend backend, const ContextOptions& options) {
  if (backend == RenderingBackend::kOsMesa) {
    return std::make_unique<OsMesa>(options.osMesaLibrary);
  }
  return std::make_unique<Egl>(options.eglLibrary);
}

std::unique_ptr<GlContext> openFirst(const ContextOptions& options) {
  std::string reasons;
  for (const RenderingBackend each : kSingle) {
    try {
      return open(each, options);
    } catch (const MachineError& error) {
      reasons += "\n  " + std::string(nameOf(each)) + ": " + error.what();
    }
  }
  throw MachineError("no rendering backend is available:" + reasons);
}

}  // namespace

RenderingBackend renderingBackendNamed(std::string_view name) {
  return static_cast<RenderingBackend>(indexAmong(name, kRenderingBackends));
}

std::unique_ptr<GlContext> openContext(const ContextOptions& options) {
  prepareEnvironment(options.threads);
  opened = true;
  if (options.backend == RenderingBackend::kAuto) {
    return openFirst(options);
  }
  return open(options.backend, options);
}

bool glWasOpened() { return opened; }

std::vector<BackendFound> findRenderingBackends(const ContextOptions& options) {
  prepareEnvironment(options.threads);
  opened = true;
  std::vector<BackendFound> found;
  for (const RenderingBackend each : kSingle) {
    try {
      const std::unique_ptr<GlContext> context = open(each, options);
      found.push_back({.name = nameOf(each), .available = true, .description = Gl(*context).description});
    } catch (const MachineError& error) {
      found.push_back({.name = nameOf(each), .available = false, .description = error.what()});
    }
  }
  return found;
}

}  // namespace careen
