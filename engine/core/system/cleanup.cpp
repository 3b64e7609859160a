#include "core/system/cleanup.h"

#include <exception>
#include <mutex>
#include <utility>

namespace careen {
namespace {

struct Registry {
  std::mutex mutex;
  std::list<std::function<void()>> undo;
};

// Never destroyed: another thread may be in it when the process ends.
Registry& registry() {
  static auto* const one = new Registry;
  return *one;
}

}  // namespace

Cleanup::Cleanup(std::function<void()> undo) {
  const std::lock_guard lock(registry().mutex);
  place_ = registry().undo.insert(registry().undo.begin(), std::move(undo));
}

Cleanup::~Cleanup() {
  const std::lock_guard lock(registry().mutex);
  registry().undo.erase(place_);
}

void cleanUpToEnd() {
  registry().mutex.lock();  // for good
  for (const std::function<void()>& undo : registry().undo) {
    try {
      undo();
    } catch (const std::exception&) {  // the others still count
    }
  }
}

}  // namespace careen
