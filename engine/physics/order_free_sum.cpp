#include "physics/order_free_sum.h"

#include <algorithm>
#include <cmath>

namespace careen {
namespace {

/// What is left of a term after each rounding to a grid.
struct Parts {
  double coarse = 0;
  double rest = 0;
};

/// Nearest multiple of ulp(anchor). The anchor is 1.5 times a power of two, so that adding a term of either
/// sign stays in its binade, and an even multiple of its ulp, so that ties round alike for either sign.
Parts onGridOf(double anchor, double term) {
  const double coarse = (anchor + term) - anchor;
  return {.coarse = coarse, .rest = term - coarse};
}

}  // namespace

double orderFreeSum(std::span<const double> terms) {
  if (terms.size() <= 2) {  // one rounded addition has both properties already
    return terms.empty() ? 0 : terms.size() == 1 ? terms[0] : terms[0] + terms[1];
  }
  double largest = 0;
  for (const double term : terms) {
    largest = std::max(largest, std::fabs(term));
  }
  double room = 4;  // all sums of the grid points stay exact: below 2⁵² of the grid's steps
  for (std::size_t n = terms.size(); n > 1; n /= 2) {
    room *= 2;
  }
  const double coarseAnchor = 1.5 * room * powerOfTwoBelow(largest);
  constexpr double kUlp = 0x1p-52;
  const double fineAnchor = coarseAnchor * (kUlp * room);
  double coarse = 0;
  double fine = 0;
  for (const double term : terms) {
    const Parts first = onGridOf(coarseAnchor, term);
    coarse += first.coarse;
    fine += onGridOf(fineAnchor, first.rest).coarse;
  }
  return coarse + fine;
}

}  // namespace careen
