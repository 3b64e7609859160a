#pragma once

#include <span>
#include <string>
#include <string_view>

namespace careen {

struct Advice {
  std::string_view sign;  ///< part of the message
  std::string_view next;
};

/// All that is advised, by message.
std::span<const Advice> allAdvice();

/// What to do next about a message that newcomers meet, as a line of its own; empty for any other.
std::string adviceOn(const std::string& message);

}  // namespace careen
