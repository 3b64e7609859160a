#include "audit/findings.h"

#include <cmath>

namespace careen {

Findings::Findings(const RunSettings& settings, const Promises& before, const Promises& after,
                   std::optional<double> pileFrom)
    : settings_(settings),
      pileFrom_(pileFrom.value_or(std::numeric_limits<double>::infinity())),
      before_(before),
      after_(after) {}

const std::optional<Promise>& Findings::promise(AuditKind kind, double time) const {
  return (isPile(time) ? after_ : before_)[indexOf(kind)];
}

void Findings::add(AuditKind kind, double rounding, const Finding& found) {
  if (found.size <= rounding) {
    return;
  }
  // A size that is no number is beyond everything.
  Finding named = found;
  if (std::isnan(named.size)) {
    named.size = std::numeric_limits<double>::infinity();
  }
  if (Finding& largest = largest_[indexOf(kind)]; named.size > largest.size) {
    largest = named;
  }
  const std::optional<Promise>& promised = promise(kind, named.time);
  std::optional<Finding>& breach = breaches_[indexOf(kind)];
  if (promised && named.promised && named.size > allowed(*promised, settings_, named.length) + rounding &&
      (!breach || named.time < breach->time)) {
    breach = named;
  }
}

}  // namespace careen
