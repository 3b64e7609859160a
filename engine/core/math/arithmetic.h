#pragma once

#include <cfenv>

namespace careen {

/// During its lifetime this thread has the default floating-point environment of C: rounding to nearest,
/// subnormal numbers, no traps. Others may have changed it: libraries built with -ffast-math when they are
/// loaded, drivers while they draw.
class DefaultFloatEnvironment {
 public:
  DefaultFloatEnvironment() {
    std::fegetenv(&before_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~DefaultFloatEnvironment() { std::fesetenv(&before_); }
  DefaultFloatEnvironment(const DefaultFloatEnvironment&) = delete;
  DefaultFloatEnvironment& operator=(const DefaultFloatEnvironment&) = delete;
  DefaultFloatEnvironment(DefaultFloatEnvironment&&) = delete;
  DefaultFloatEnvironment& operator=(DefaultFloatEnvironment&&) = delete;

 private:
  std::fenv_t before_{};
};

}  // namespace careen
