#pragma once

#include <algorithm>
#include <utility>

namespace careen {

/// A stretch over which a function falls through zero, and where to look next: inverse quadratic
/// interpolation through the two ends and the end before them, while they lie on a curve that allows it, else
/// the middle (T. R. Chandrupatla, Adv. Eng. Softw. 28, 1997). The first time it is the chord.
struct FallingBracket {
  double low = 0;        ///< not yet fallen there
  double high = 0;       ///< fallen there
  double valueLow = 0;   ///< ≥ 0
  double valueHigh = 0;  ///< < 0

  bool hasFormer = false;
  double former = 0;  ///< the end that the newer one replaced: on the same side, farther away
  double valueFormer = 0;
  bool highIsNewer = false;

  double width() const { return high - low; }

  /// Where the function is next to be computed, for add(): between the ends and, if they are that far apart,
  /// at least `least` from both.
  double next(double least) const {
    const double margin = std::min(0.5, least / width());
    const double part = std::clamp(hasFormer ? partOfCurve() : partOfChord(), margin, 1 - margin);
    return highIsNewer ? high - part * width() : low + part * width();
  }

  void add(double at, double value) {
    highIsNewer = value < 0;
    former = std::exchange(highIsNewer ? high : low, at);
    valueFormer = std::exchange(highIsNewer ? valueHigh : valueLow, value);
    hasFormer = true;
  }

 private:
  // [1] Of the way from the newer end to the other.
  double partOfChord() const {
    const double newer = highIsNewer ? valueHigh : valueLow;
    const double other = highIsNewer ? valueLow : valueHigh;
    return newer / (newer - other);
  }

  double partOfCurve() const {
    const double newer = highIsNewer ? valueHigh : valueLow;
    const double other = highIsNewer ? valueLow : valueHigh;
    const double away = (highIsNewer ? low : high) - (highIsNewer ? high : low);
    const double back = former - (highIsNewer ? high : low);
    const double near = away / (away - back);
    const double rise = (newer - other) / (valueFormer - other);
    if (!(rise * rise < near && (1 - rise) * (1 - rise) < 1 - near)) {
      return 0.5;
    }
    return newer / (other - newer) * (valueFormer / (other - valueFormer)) +
           back / away * (newer / (valueFormer - newer)) * (other / (valueFormer - other));
  }
};

}  // namespace careen
