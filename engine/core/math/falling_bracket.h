#pragma once

namespace careen {

/// A stretch over which a function falls through zero: regula falsi, where the value at the end that stays is
/// halved each time, so that no end stays for good. (The Illinois rule of M. Dowell, P. Jarratt, BIT 11,
/// 1971, halves from the second time on only and is faster; it would give other bits.)
struct FallingBracket {
  double low = 0;        ///< not yet fallen there
  double high = 0;       ///< fallen there
  double valueLow = 0;   ///< ≥ 0, or less by the rule
  double valueHigh = 0;  ///< ≤ 0, or nearer to 0 by the rule

  double width() const { return high - low; }
  /// Where the chord between the ends falls through zero.
  double cut() const { return high - valueHigh * (high - low) / (valueHigh - valueLow); }
  void moveLow(double to, double value) {
    low = to;
    valueLow = value;
    valueHigh /= 2;
  }
  void moveHigh(double to, double value) {
    high = to;
    valueHigh = value;
    valueLow /= 2;
  }
};

}  // namespace careen
