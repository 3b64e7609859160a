#pragma once

#include <cfenv>

namespace careen {

/// During its lifetime this thread has the default floating-point environment of C: rounding to nearest,
/// subnormal numbers, no traps. Others may have changed it: libraries built with -ffast-math when they are
/// loaded, drivers while they draw.
class UsualArithmetic {
 public:
  UsualArithmetic() {
    std::fegetenv(&before_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~UsualArithmetic() { std::fesetenv(&before_); }
  UsualArithmetic(const UsualArithmetic&) = delete;
  UsualArithmetic& operator=(const UsualArithmetic&) = delete;
  UsualArithmetic(UsualArithmetic&&) = delete;
  UsualArithmetic& operator=(UsualArithmetic&&) = delete;

 private:
  std::fenv_t before_{};
};

}  // namespace careen
