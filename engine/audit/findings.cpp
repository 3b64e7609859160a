#include "audit/findings.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace careen {

Findings::Findings(const RunSettings& settings, const Promises& before, const Promises& after,
                   std::vector<double> crowdFrom)
    : settings_(settings), crowdFrom_(std::move(crowdFrom)), before_(before), after_(after) {}

bool Findings::isCrowd(double time, std::span<const std::size_t> bodies) const {
  return std::any_of(bodies.begin(), bodies.end(),
                     [&](std::size_t body) { return time >= crowdFrom_[body]; });
}

const std::optional<Promise>& Findings::promise(AuditKind kind, const Finding& finding) const {
  return (isCrowd(finding.time, finding.bodies) ? after_ : before_)[indexOf(kind)];
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
  const std::optional<Promise>& promised = promise(kind, named);
  std::optional<Finding>& breach = breaches_[indexOf(kind)];
  if (promised && named.promised && named.size > allowed(*promised, settings_, named.length) + rounding &&
      (!breach || named.time < breach->time)) {
    breach = named;
  }
}

}  // namespace careen
