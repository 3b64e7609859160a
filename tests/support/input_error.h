#pragma once

#include <string>

#include "core/error.h"

namespace careen {

/// What an InputError thrown by `action` says; "no error" if it throws none.
template <class Action>
std::string inputErrorOf(Action action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace careen
