#include <GL/glcorearb.h>

#include "render/rendering_backend.h"

#include <cstdlib>
#include <span>

#include "core/error.h"
#include "render/egl.h"
#include "render/gl.h"
#include "render/osmesa.h"

namespace careen {
namespace {

bool opened = false;

constexpr std::span kSingle = std::span(kRenderingBackends).subspan(1);  // all but auto

// Read by Mesa when a library of its makes the first context.
void prepareEnvironment(const std::optional<int>& threads) {
  if (threads) {
    if (*threads < 0 || *threads > kMostThreads) {
      throw InputError("threads: found " + std::to_string(*threads) + ", expected 0 to " +
                       std::to_string(kMostThreads));
    }
    setenv("LP_NUM_THREADS", std::to_string(*threads).c_str(), 1);
  }
  // Code for vectors of 512 bits crashes in Mesa 22.3; those of 256 give the same pixels.
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
  for (const NamedBackend& each : kSingle) {
    try {
      return open(each.backend, options);
    } catch (const MachineError& error) {
      reasons += "\n  " + std::string(each.name) + ": " + error.what();
    }
  }
  throw MachineError("no rendering backend can be had:" + reasons);
}

}  // namespace

RenderingBackend renderingBackendNamed(std::string_view name) {
  std::string known;
  for (const NamedBackend& each : kRenderingBackends) {
    if (each.name == name) {
      return each.backend;
    }
    known += (known.empty() ? "" : ", ") + std::string(each.name);
  }
  throw InputError("found '" + std::string(name) + "', expected one of: " + known);
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
  for (const NamedBackend& each : kSingle) {
    try {
      const std::unique_ptr<GlContext> context = open(each.backend, options);
      found.push_back({.name = each.name, .available = true, .description = Gl(*context).description});
    } catch (const MachineError& error) {
      found.push_back({.name = each.name, .available = false, .description = error.what()});
    }
  }
  return found;
}

}  // namespace careen
