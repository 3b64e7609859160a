#pragma once

#include <algorithm>
#include <cmath>

#include "physics/search/time_of_impact.h"

namespace careen {

/// [s] later than any search window.
inline constexpr double kNever = 0x1p500;
/// [1] Enlarges bounding spheres, so that rounding never skips contact of a corner.
inline constexpr double kSphere = 1 + 0x1p-40;

/// [1/s²] K with |r̈| ≤ K|r| for every r fixed in the body.
inline double turningBound(const MovingBox& box) {
  return box.angularSpeedBound * box.angularSpeedBound + box.angularAccelerationBound;
}

/// [m/s²] Of the components of a flight's acceleration.
inline Vec3 mostOf(const MovingBox& box) {
  return box.acceleration.cwiseAbs() + box.lasts * box.jerk.cwiseAbs();
}

/// Faster than anything that falls from rest within 8 tolerances of contact.
inline bool fasterThanSinking(double approach, double curvature, double tolerance) {
  return approach > 0 && approach * approach > 16 * curvature * tolerance;
}

/// [s] Newton step to the root of a gap closing at `approach`; 0 where its curvature makes the step unsafe.
inline double newtonStep(double gap, double approach, double curvature) {
  const bool safe = approach * approach > 4 * curvature * std::fabs(gap);
  return safe ? gap / approach : 0;
}

/// The time-of-impact search of time_of_impact.h, shared by walls and boxes. An Approach represents one pair:
///       skip(t)              t, or the later time before which bounding spheres rule out contact
///       moveTo(t)            evaluates the pair at t, for the calls below
///       gap(), tolerance()   [m] the gap, and the rounding below which it counts as zero
///       closing()            the gap's rate ahead is negative beyond rounding
///       closesHard()         closes faster than falling from rest through a few tolerances could
///       freeStep(floor, most) [s] proved time step in which the gap stays above `floor`, at most `most`
///       polish(level)        [s] Newton step from here to where the gap is `level`, 0 where it is not safe
///       describe()           the contact at this time
template <class Approach>
FirstContact findFirstContact(Approach& approach, const SearchWindow& window) {
  // Evaluation budget: when exceeded, the search returns what it has proved. Evaluations with the gap within
  // rounding, or so near to it that hardly any time is proved free, as where edges that were parallel turn on
  // each other: when exceeded, the pair is in lasting contact.
  constexpr int kMostEvaluations = 50'000;
  constexpr int kMostGrazing = 500;
  constexpr double kNearRounding = 0x1p12;
  const auto noneUntil = [](double time, int evaluations) {
    FirstContact none;
    none.time = time;
    none.evaluations = evaluations;
    return none;
  };

  int evaluations = 1;
  const auto found = [&](ContactKind kind, double time) {
    FirstContact contact = approach.describe();
    contact.kind = kind;
    contact.time = time;
    contact.evaluations = evaluations;
    return contact;
  };

  double t = window.from;
  bool grazing = false;  // gap zero within rounding, not closing
  double base = 0;       // gap when grazing began, at most 0
  int grazes = 0;
  int creeps = 0;
  FirstContact touch;
  for (; evaluations <= kMostEvaluations; ++evaluations) {
    if (!grazing) {
      t = approach.skip(t);
    }
    if (t >= window.until) {
      return noneUntil(window.until, evaluations - 1);
    }
    approach.moveTo(t);
    const double gap = approach.gap();
    const double tolerance = approach.tolerance();
    double floor = 0;
    creeps += gap <= kNearRounding * tolerance ? 1 : 0;
    if (gap > tolerance) {
      grazing = false;
      if (creeps > kMostGrazing) {
        return found(ContactKind::kTouching, t);
      }
    } else if (approach.closing() && (!grazing || approach.closesHard())) {
      // A root before the start of the search does not count: boxes that overlap by rounding may have touched
      // ever since. They meet anew where they are as deep as they were, when other corners come down to it.
      const double root = t + approach.polish(grazing ? base : 0);
      return found(ContactKind::kImpact,
                   root < (grazing ? touch.time : window.from) ? t : std::min(root, window.until));
    } else {
      if (!grazing) {
        grazing = true;
        grazes = 0;
        base = std::min(gap, 0.0);
        touch = found(ContactKind::kTouching, t);
      }
      ++grazes;
      touch.evaluations = evaluations;
      if (gap <= base - 2 * tolerance || grazes > kMostGrazing) {
        return touch;
      }
      floor = base - 4 * tolerance;
    }
    const double next = t + approach.freeStep(floor, window.until - t);
    if (next <= t) {
      // The gap closes within one ulp of the time.
      return found(approach.closing() ? ContactKind::kImpact : ContactKind::kTouching, t);
    }
    t = next;
  }
  return noneUntil(t, kMostEvaluations);
}

}  // namespace careen
