#pragma once

#include <string>

namespace careen {

/// What to do next about a message that newcomers meet, as a line of its own; empty for any other.
std::string adviceOn(const std::string& message);

}  // namespace careen
