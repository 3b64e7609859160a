#pragma once

#include <cstdlib>
#include <string>

namespace careen {

/// The program under test: the environment's CAREEN_PROGRAM, else the one built.
inline std::string program() {
  const char* const given = std::getenv("CAREEN_PROGRAM");
  return given != nullptr ? given : CAREEN_BINARY;
}

}  // namespace careen
