#pragma once

#include <cstdlib>
#include <string>

namespace careen {

/// The program whose command line is tested: CAREEN_PROGRAM of the environment in place of the one built.
inline std::string program() {
  const char* const given = std::getenv("CAREEN_PROGRAM");
  return given != nullptr ? given : CAREEN_BINARY;
}

}  // namespace careen
