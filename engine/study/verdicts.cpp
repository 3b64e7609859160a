#include "study/verdicts.h"

namespace careen {

std::string verdictOf(const Attempt* attempt) {
  if (attempt == nullptr || !attempt->failure.empty()) {
    return "–";
  }
  return attempt->judgement.error <= kRight ? "right" : "wrong";
}

std::optional<double> promiseOf(const CaseResult& result, double factor) {
  const double tolerance = factor * result.usualTolerance;
  for (const Attempt& attempt : result.attempts) {
    const bool fits =
        attempt.tolerance == 0 || (attempt.sameTo <= tolerance && tolerance <= attempt.tolerance);
    if (attempt.contestant == "exact" && fits && attempt.failure.empty() && tolerance > 0 &&
        attempt.judgement.displacement) {
      return *attempt.judgement.displacement / tolerance;
    }
  }
  return std::nullopt;
}

}  // namespace careen
