#pragma once

#include <bit>
#include <utility>

#include "core/math/elementary.h"
#include "core/math/wide.h"

namespace careen {

/// An angle as a whole number of quarter turns and a remainder [rad] of at most π/4 in magnitude.
template <class Real>
struct TurnedAngle {
  Real quarterTurns;
  Real rest;
};

/// An angle linear in time, kept in quarter turns so that whole turns drop out without error however many
/// there are: after t seconds its error is at most 2⁻⁷⁸ of rate · t (measured) plus a rounding of one radian.
template <class Real>
class LinearPhase {
 public:
  LinearPhase() = default;
  /// rate [rad/s]; at t = 0 the angle is `quarterTurns` (a whole number) and `rest` [rad].
  LinearPhase(const Wide<Real>& rate, const Real& quarterTurns, const Real& rest)
      : rate_(rate * (2 / elementary::pi<Real>())),
        offset_(quarterTurns + rest * (2 / elementary::pi<Real>())) {}

  /// t [s], shift [quarter turns] added.
  TurnedAngle<Real> at(const Real& t, const Real& shift = 0) const {
    const Real turns = rate_ * t + (offset_ + shift);
    const Real whole = elementary::nearestInteger(turns);
    return {whole, (turns - whole) * (elementary::pi<Real>() / 2)};
  }

  /// The same with `rest` to full relative accuracy where the angle passes a multiple of a quarter turn.
  TurnedAngle<Real> preciselyAt(const Real& t) const { return at(t); }

  /// Sine and cosine of two such angles.
  friend std::pair<elementary::SinCos<Real>, elementary::SinCos<Real>> sinCosOfBoth(const LinearPhase& a,
                                                                                    const LinearPhase& b,
                                                                                    const Real& t) {
    const TurnedAngle<Real> p = a.at(t);
    const TurnedAngle<Real> q = b.at(t);
    return {elementary::sinCosQuarterTurns(p.quarterTurns, p.rest),
            elementary::sinCosQuarterTurns(q.quarterTurns, q.rest)};
  }

 private:
  Real rate_ = 0;    // [quarter turns/s]
  Real offset_ = 0;  // [quarter turns]
};

template <>
class LinearPhase<double> {
 public:
  LinearPhase() = default;
  LinearPhase(const DoubleDouble& rate, double quarterTurns, double rest)
      : wholeOffset_(quarterTurns), restOfOffset_(rest * kQuarterTurnsPerRadian.hi) {
    const DoubleDouble turnRate = normalized(rate * kQuarterTurnsPerRadian);
    const DoubleDouble parts = split(turnRate.hi);
    rate_ = parts.hi;
    restOfRate_ = parts.lo + turnRate.lo;
  }

  TurnedAngle<double> at(double t, double shift = 0) const {
    const DoubleDouble time = split(t);
    const double coarse = rate_ * time.hi;  // 26 bits each: exact
    const double fine = (rate_ * time.lo + restOfRate_ * t) + ((wholeOffset_ + restOfOffset_) + shift);
    const double whole = elementary::nearestInteger(coarse + fine);
    return {whole, ((coarse - whole) + fine) * kRadiansPerQuarterTurn};
  }

  TurnedAngle<double> preciselyAt(double t) const {
    const DoubleDouble time = split(t);
    const double coarse = rate_ * time.hi;
    const double turned = elementary::nearestInteger(coarse);
    const DoubleDouble sum = twoSum(coarse - turned, restOfOffset_);
    const double fine = sum.lo + (rate_ * time.lo + restOfRate_ * t);
    const double more = elementary::nearestInteger(sum.hi + fine);
    return {(turned + wholeOffset_) + more, ((sum.hi - more) + fine) * kRadiansPerQuarterTurn};
  }

  /// Sine and cosine of two such angles, side by side.
  friend std::pair<elementary::SinCos<double>, elementary::SinCos<double>> sinCosOfBoth(const LinearPhase& a,
                                                                                        const LinearPhase& b,
                                                                                        double t) {
    using Pair = elementary::detail::Pair;
    const DoubleDouble time = split(t);
    const Pair rate = {a.rate_, b.rate_};
    const Pair restOfRate = {a.restOfRate_, b.restOfRate_};
    const Pair offset = {a.wholeOffset_ + a.restOfOffset_, b.wholeOffset_ + b.restOfOffset_};
    const Pair coarse = rate * time.hi;
    const Pair fine = (rate * time.lo + restOfRate * t) + offset;
    const Pair whole =
        ((coarse + fine) + elementary::detail::kWholeNumberShift) - elementary::detail::kWholeNumberShift;
    const Pair rest = ((coarse - whole) + fine) * kRadiansPerQuarterTurn;
    const elementary::SinCos<Pair> both =
        elementary::detail::rotatedByQuarterTurns(elementary::detail::sinCosNearZero(rest), whole);
    return {{both.sin[0], both.cos[0]}, {both.sin[1], both.cos[1]}};
  }

 private:
  static constexpr DoubleDouble kQuarterTurnsPerRadian{0x1.45f306dc9c883p-1, -0x1.6b01ec5417056p-55};
  static constexpr double kRadiansPerQuarterTurn = 0x1.921fb54442d18p+0;

  double rate_ = 0;          // [quarter turns/s] the leading 26 bits
  double restOfRate_ = 0;    // [quarter turns/s]
  double wholeOffset_ = 0;   // [quarter turns] a whole number
  double restOfOffset_ = 0;  // [quarter turns]
};

}  // namespace careen
