#pragma once

#include <cstddef>
#include <vector>

#include "physics/world/partner.h"
#include "question/true_spans.h"
#include "trajectory/trajectory.h"

namespace careen {

/// [m] Boxes and walls that are no farther apart touch: what the run's method promises not to go deeper into
/// each other (audit/promises.h), for exact contact 4 times the tolerance and 1e-9 m, for crowds 3 times
/// theirs; of study methods as for exact contact; of a table 0.01 of half the diagonal of the smallest box
/// that can move, as the audit holds it to.
struct TouchingGaps {
  double usual = 0;
  double crowd = 0;
};
TouchingGaps touchingGaps(const Trajectory& run);

/// [s] While a box touches another box or a wall, from the start of the run to `until`: while their gap is
/// not above touchingGaps(), that of crowds from the time on at which one of the two is in one, and at the
/// times of their impacts. The gap is that of the audit (separationOf in audit/overlap.h). A span that begins
/// in the flight, or step, which an impact of the two ends begins at that impact, exactly.
///
/// Boxes in flight that come that near are not missed, unless they come nearer by less than a thousandth of
/// it. Where both ends of a motion touch, and thrice between, within a part in which no corner goes farther
/// than 1/64 of half the smaller box's diagonal, they touch all the time.
std::vector<TrueSpan> touchingSpans(const Trajectory& run, std::size_t body, Partner with, double until);

}  // namespace careen
