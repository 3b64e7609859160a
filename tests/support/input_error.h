#pragma once

#include <string>

#include "core/error.h"

namespace careen {

/// Message of the InputError thrown by `action`; "no error" if it throws none.
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
