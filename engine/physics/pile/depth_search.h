#pragma once

#include <algorithm>

namespace careen {

/// How deep two boxes are in each other on their way, of which `motion` [m] is how far points of the one may
/// move as seen from the other: no gap changes by more.
struct DepthSearch {
  double motion = 0;
  double deep = 0;      ///< [m] depth that is looked for
  double swing = 0;     ///< [m] parts of the way in which they move less are not divided,
  double shortest = 0;  ///< [1] nor those that are as short
};

/// [m] The deepest seen between 0 and 1, where the gaps [m] are known, without these; gapAt(part) may be a
/// lower bound of gaps that are above -deep.
template <class GapAt>
double searchDepth(const DepthSearch& search, const GapAt& gapAt, double gapAt0, double gapAt1) {
  double deepest = 0;
  const auto look = [&](const auto& again, double from, double gapFrom, double length, double gapTo) {
    if (length <= search.shortest || search.motion * length <= search.swing ||
        0.5 * (gapFrom + gapTo - search.motion * length) > -search.deep) {
      return;
    }
    const double half = 0.5 * length;
    const double gap = gapAt(from + half);
    deepest = std::max(deepest, -gap);
    again(again, from, gapFrom, half, gap);
    again(again, from + half, gap, half, gapTo);
  };
  look(look, 0, gapAt0, 1, gapAt1);
  return deepest;
}

}  // namespace careen
