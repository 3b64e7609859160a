#pragma once

#include <optional>
#include <vector>

#include "physics/world/partner.h"
#include "question/question.h"
#include "trajectory/trajectory.h"

namespace careen {

/// A moment at which a statement becomes true.
struct Moment {
  double time = 0;                   ///< [s]
  std::optional<Partner> with = {};  ///< of kTouches and kLeaves: the other one
};

/// All moments from 0 to `until`, in order of time; 0 among them if it is true from the start.
///
/// - kTouches: when one begins to touch the other (touching_spans.h); with anything, for each other one.
/// - kLeaves: when it ends to: the gap rises above that in touching_spans.h, after a bounce as much later
/// than
///   the impact as it takes to rise so far.
/// - kBelow, kAbove: quantity_spans.h.
/// - kRests: when the box comes to rest, the last of all boxes that can move. One that is struck may come to
///   rest again. Fixed boxes always rest. Study methods and tables of poses know no rest.
std::vector<Moment> moments(const Trajectory& run, const Question& question, double until);
/// To the end of the run.
std::vector<Moment> moments(const Trajectory& run, const Question& question);

}  // namespace careen
