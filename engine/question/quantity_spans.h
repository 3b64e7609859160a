#pragma once

#include <vector>

#include "question/question.h"
#include "question/true_spans.h"
#include "trajectory/trajectory.h"

namespace careen {

/// [s] While a quantity of a question, kBelow or kAbove, is beyond its level, from the start of the run to
/// `until`. Times are roots in the closed forms of the motion, to rounding; where the quantity jumps, as
/// speed at an impact, that time. Of places and distances, and of spin, energy and speed in flight, no moment
/// is missed but of a graze that exceeds the level by less than 1e-12 of it; of speed, spin, energy and tilt
/// in steps of contact, by less than 1e-9.
///
/// In steps of contact in which no corner goes farther than a thousandth of the tolerance, speed, spin and
/// energy are those at the start: what follows is how the place was corrected.
std::vector<TrueSpan> quantitySpans(const Trajectory& run, const Question& question, double until);

}  // namespace careen
