#include "core/math/arithmetic.h"

#include <limits>

#include <gtest/gtest.h>

namespace careen {
namespace {

// volatile: the compiler must not evaluate these in advance.
volatile double smallest = std::numeric_limits<double>::min();
volatile double one = 1;
volatile double third = 3;

double oneThird() { return one / third; }

TEST(DefaultFloatEnvironment, roundsToTheNearestWhateverWasSetBefore) {
  const double nearest = oneThird();
  std::fesetround(FE_UPWARD);
  const double up = oneThird();
  double within = 0;
  {
    const DefaultFloatEnvironment usual;
    within = oneThird();
  }
  const int after = std::fegetround();
  std::fesetround(FE_TONEAREST);
  EXPECT_GT(up, nearest);
  EXPECT_EQ(within, nearest);
  EXPECT_EQ(after, FE_UPWARD) << "the previous mode is not restored";
}

#ifdef __x86_64__
// Bits 6 and 15 of MXCSR: subnormal inputs count as 0, and subnormal results become 0.
TEST(DefaultFloatEnvironment, keepsSmallNumbers) {
  const unsigned before = __builtin_ia32_stmxcsr();
  __builtin_ia32_ldmxcsr(before | 0x8040U);
  const double flushed = smallest / 2;
  double within = 0;
  {
    const DefaultFloatEnvironment usual;
    within = smallest / 2;
  }
  __builtin_ia32_ldmxcsr(before);
  EXPECT_EQ(flushed, 0);
  EXPECT_EQ(within, std::numeric_limits<double>::min() / 2);
}
#endif

}  // namespace
}  // namespace careen
