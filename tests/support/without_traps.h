#pragma once

#include <cfenv>

namespace careen {

/// Lets floating-point exceptions pass while it lives: for tests of how the engine meets infinities.
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
