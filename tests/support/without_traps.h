#pragma once

#include <cfenv>

namespace careen {

/// Disables floating-point traps during its lifetime: for tests of how the engine handles infinities.
class WithoutTraps {
 public:
  WithoutTraps() { feholdexcept(&environment_); }
  ~WithoutTraps() { fesetenv(&environment_); }
  WithoutTraps(const WithoutTraps&) = delete;
  WithoutTraps& operator=(const WithoutTraps&) = delete;
  WithoutTraps(WithoutTraps&&) = delete;
  WithoutTraps& operator=(WithoutTraps&&) = delete;

 private:
  fenv_t environment_{};
};

}  // namespace careen
