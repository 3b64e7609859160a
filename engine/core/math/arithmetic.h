#pragma once

#include <cfenv>

namespace careen {

/// While it lives, this thread computes as the program does when it starts: results rounded to the nearest,
/// numbers below 2.2e-308 kept, nothing trapped. Others may have changed that: libraries built with
/// -ffast-math do so when they are loaded, drivers while they draw.
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
