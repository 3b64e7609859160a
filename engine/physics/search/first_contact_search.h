#pragma once

#include <algorithm>
#include <cmath>

#include "physics/search/time_of_impact.h"

namespace careen {

/// [s] beyond any search.
inline constexpr double kNever = 0x1p500;
/// [1] Bounding spheres are taken larger by this, so that rounding never skips a corner's touch.
inline constexpr double kSphere = 1 + 0x1p-40;

/// [1/s²] K with |r̈| ≤ K|r| for every r fixed in the body.
inline double turningBound(const MovingBox& box) {
  return box.angularSpeedBound * box.angularSpeedBound + box.angularAccelerationBound;
}

/// What falls from rest within 8 tolerances of contact is slower than this.
inline bool fasterThanSinking(double approach, double curvature, double tolerance) {
  return approach > 0 && approach * approach > 16 * curvature * tolerance;
}

/// [s] to the root of a gap that closes at `approach`; 0 where its curvature makes Newton's step unsafe.
inline double newtonStep(double gap, double approach, double curvature) {
  const bool safe = approach * approach > 4 * curvature * std::fabs(gap);
  return safe ? gap / approach : 0;
}

/// The search of time_of_impact.h, the same for walls and boxes. An Approach knows one pair:
///   skip(t)              t, or the later time before which bounding spheres rule contact out
///   moveTo(t)            evaluates the pair at t, for the calls below
///   gap(), tolerance()   [m] the gap and what is zero within rounding
///   closing()            the gap's rate to come is negative beyond rounding
///   closesHard()         faster than sinking from rest through a few tolerances could make it
///   freeStep(floor, most) [s] proved: the gap stays above `floor` so long, at most `most`
///   polish()             [s] from here to the root by one Newton step, 0 where that is not safe
///   describe()           the contact at this moment
template <class Approach>
FirstContact findFirstContact(Approach& approach, const SearchWindow& window) {
  // A search that has not ended by then hands back what it has proved; a pair that hovers within rounding for
  // so long is in lasting contact.
  constexpr int kMostEvaluations = 50'000;
  constexpr int kMostGrazing = 500;
  const auto noneUntil = [](double time, int evaluations) {
    FirstContact none;
    none.time = time;
    none.evaluations = evaluations;
    return none;
  };

  double t = window.from;
  bool grazing = false;  // within rounding of contact, not closing
  double base = 0;       // the gap where grazing began, at most 0
  int grazes = 0;
  FirstContact touch;
  for (int evaluations = 1; evaluations <= kMostEvaluations; ++evaluations) {
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
    if (gap > tolerance) {
      grazing = false;
    } else if (approach.closing() && (!grazing || approach.closesHard())) {
      FirstContact impact = approach.describe();
      impact.kind = ContactKind::kImpact;
      // A root before the search began is none: boxes that overlap by rounding may have touched ever since.
      const double root = t + approach.polish();
      impact.time = root < (grazing ? touch.time : window.from) ? t : std::min(root, window.until);
      impact.evaluations = evaluations;
      return impact;
    } else {
      if (!grazing) {
        grazing = true;
        grazes = 0;
        base = std::min(gap, 0.0);
        touch = approach.describe();
        touch.kind = ContactKind::kTouching;
        touch.time = t;
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
      // The gap closes within one unit in the last place of the time.
      FirstContact now = approach.describe();
      now.kind = approach.closing() ? ContactKind::kImpact : ContactKind::kTouching;
      now.time = t;
      now.evaluations = evaluations;
      return now;
    }
    t = next;
  }
  return noneUntil(t, kMostEvaluations);
}

}  // namespace careen
