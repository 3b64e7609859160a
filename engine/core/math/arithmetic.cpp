#include "core/math/arithmetic.h"

#include <cfloat>
#include <limits>

namespace careen {

// Requirements for the same bits everywhere; see assets/manual/reproducibility.md.
static_assert(std::numeric_limits<double>::is_iec559 && std::numeric_limits<double>::digits == 53);
static_assert(FLT_EVAL_METHOD == 0, "expressions of doubles are computed in doubles: no x87");
#ifdef __FAST_MATH__
#error "-ffast-math does not compute what the source says"
#endif

}  // namespace careen
