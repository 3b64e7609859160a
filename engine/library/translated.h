#pragma once

#include <cstddef>
#include <cstdlib>
#include <string>

#include "core/error.h"
#include "library/careen.h"

namespace careen {

/// Messages of the engine begin with "file:line:column: " where a place in a file is to blame.
inline v1::SceneError placed(const std::string& message, const std::string& name) {
  std::size_t line = 0;
  std::size_t column = 0;
  if (message.starts_with(name + ":")) {
    const char* at = message.c_str() + name.size() + 1;
    char* end = nullptr;
    const unsigned long first = std::strtoul(at, &end, 10);
    if (end != at && *end == ':') {
      at = end + 1;
      const unsigned long second = std::strtoul(at, &end, 10);
      if (end != at && *end == ':') {
        line = first;
        column = second;
      }
    }
  }
  return {message, message.starts_with(name) ? name : "", line, column};
}

/// Errors of the engine become those of the header; `name` is what messages call the scene.
template <class Work>
auto translated(const std::string& name, Work&& work) {
  try {
    return work();
  } catch (const InputError& error) {
    throw placed(error.what(), name);
  } catch (const Error& error) {
    throw v1::Error(error.what());
  }
}

}  // namespace careen
