#pragma once

#include <cmath>
#include <limits>

#include "core/math/elementary.h"
#include "core/math/wide.h"

namespace careen {

/// Elliptic integrals and the nome of one modulus, all from one descending Landen transformation.
///
/// The ladder starts from a₀ ≥ b₀ > 0, whose ratio b₀/a₀ = √(1−k²) is the complementary modulus kc, and takes
///
///     aₙ₊₁ = (aₙ + bₙ)/2,   bₙ₊₁ = √(aₙ bₙ),   gap dₙ = aₙ − bₙ,   dₙ₊₁ = dₙ ℓₙ,
///     ℓₙ = dₙ / (4 (aₙ₊₁ + bₙ₊₁)).
///
/// The gap is an input and is never computed by subtraction, so that a nearly circular modulus keeps all
/// digits. Each level squares the nome; ℓₙ is the nome of level n up to a relative 2ℓₙ⁴, so a few levels
/// suffice: the ladder ends at the first N with ℓ³ well below rounding, and the remainder at that level is
/// summed from the theta series. Everything is homogeneous in (a₀, b₀): no division by a₀ is needed.
///
/// An integral is a recurrence that takes one step per level (the structs below). They are advanced side by
/// side, in one loop, because each is a chain of divisions that alone leaves the processor idle:
///
///     for (bool more = true; more;) {
///       more = ladder.descend();
///       phase.step(ladder.level());
///       …
///     }
///
/// Sources: L. V. King, On the Direct Numerical Calculation of Elliptic Functions and Integrals, 1924; R.
/// Bulirsch, Numer. Math. 7, 1965, and 13, 1969 (cel, el1), here in the form that halves at each level
/// instead of doubling; Whittaker & Watson ch. 21 for the theta functions. Not used: Carlson's
/// duplication: it needs three square roots per step, gains two bits with each, and none of its steps can be
/// shared between the integrals.
///
/// `Number` is the type of the levels, `Real` that of phases and nomes.
template <class Real, class Number = Wide<Real>>
class LandenLadder {
 public:
  struct Level {
    Real upper, lower, gap;  // aₙ, bₙ, dₙ
    Real product;            // aₙ bₙ
  };

  /// a ≥ b > 0, gap = a − b to full relative accuracy.
  LandenLadder(const Number& a, const Number& b, const Real& gap)
      : upper_(a), lower_(b), product_(a * b), gap_(gap) {}

  /// Descends one level; false when it was the last one needed.
  bool descend() {
    using std::sqrt;
    const Real upper = static_cast<Real>(upper_);
    const Real lower = static_cast<Real>(lower_);
    level_ = {upper, lower, gap_, upper * lower};
    const Number above = upper_;
    upper_ = half(Number(upper_ + lower_));
    ++descents_;
    const Real guess = gap_ / (8 * static_cast<Real>(upper_));  // ℓₙ as if bₙ₊₁ were aₙ₊₁
    const Real cube = guess * guess * guess;
    if (cube <= std::numeric_limits<Real>::epsilon() / 4096 || descents_ == kMostDescents) {
      lambda_ = guess + 4 * cube;
      gap_ *= lambda_;
      return false;
    }
    if (descents_ > 1) {
      product_ = above * lower_;
    }
    lower_ = sqrt(product_);
    lambda_ = gap_ / (4 * (static_cast<Real>(upper_) + static_cast<Real>(lower_)));
    gap_ *= lambda_;
    return true;
  }

  /// The level from which descend() went down, N at the end.
  const Level& level() const { return level_; }
  /// Product a b of that level in full precision; not for the last unless that is the first. a₀ b₀ before the
  /// first descent.
  const Number& product() const { return product_; }

  /// The arithmetic–geometric mean M of a₀ and b₀, after the last descent. K = π a₀ / (2 M).
  Number mean() const { return upper_ - Number(gap_ / 2); }

  /// a b − M² for the last level if it is not the first, whose product is known in full precision.
  Real excessOfLastProduct() const {
    return descents_ == 1 ? Real(0) : Real(gap_ * (Real(0.75) * gap_ - static_cast<Real>(upper_)));
  }

  /// Q, the nome of the last level.
  const Real& lastNome() const { return lambda_; }

  /// Value at a₀ and b₀ from that at the last level, for q and all quantities squared along with it.
  Real atTop(Real x) const {
    using std::sqrt;
    for (int n = 1; n < descents_; ++n) {
      x = sqrt(x);
    }
    return x;
  }

  /// q = exp(−πK'/K).
  Real nome() const { return atTop(lambda_); }

 private:
  static constexpr int kMostDescents =
      24;  // 11 reach kc = 1e-150 in double, 17 reach 1e-4900 in quadruple precision

  Number upper_;
  Number lower_;
  Number product_;
  Real gap_;
  Real lambda_ = 0;
  int descents_ = 0;
  Level level_{};
};

/// πu/2K [rad] in [0, π] for the u in [0, 2K] with given cn u / sn u.
///
/// With y = aₙ cs u the angle doubles from level to level: y ← (y − ab/y)/2. Crossings of π are counted.
template <class Real>
class EllipticPhase {
 public:
  /// a₀ cs u.
  explicit EllipticPhase(const Real& a0Cotangent) : y_(a0Cotangent) {}

  template <class Level>
  void step(const Level& level) {
    using std::abs;
    halfTurns_ = 2 * halfTurns_ + (y_ < 0 ? 1 : 0);
    scale_ /= 2;
    const Real tiny = square(std::numeric_limits<Real>::epsilon());
    if (abs(y_) * level.upper > level.product * tiny) {
      y_ = (y_ - level.product / y_) / 2;
    } else {
      y_ = (y_ < 0 ? level.upper : Real(-level.upper)) / tiny;  // a quarter turn to rounding
    }
  }

  Real value(const Real& mean) const {
    return scale_ * (elementary::atan2(mean, y_) + halfTurns_ * elementary::pi<Real>());
  }

 private:
  Real y_;
  Real halfTurns_ = 0;
  Real scale_ = 1;
};

/// exp(−πw/2K) for the w in [0, K'] with given sn(w, k'): phase for an imaginary argument, x = sn/aₙ = i/y.
/// Its recurrence loses the minus sign, and every term is positive.
template <class Real>
class EllipticDecay {
 public:
  /// sn/a₀, and 1 − sn to full relative accuracy.
  EllipticDecay(const Real& sinePerA0, const Real& oneMinusSine) : x_(sinePerA0), rest_(oneMinusSine) {}

  template <class Level>
  void step(const Level& level) {
    x_ = below_.x;
    rest_ = below_.rest;
    last_ = {level.upper, level.lower, level.gap};
    const Real inverse = 1 / (1 + level.product * x_ * x_);
    below_ = {2 * x_ * inverse, rest_ * (rest_ + level.gap * x_) * inverse};
  }

  /// From the last level by theta series to the order Q², with E = exp(−πw/2K) and Z = Q/E there.
  template <class Ladder>
  Real value(const Ladder& ladder) const {
    using std::sqrt;
    const Real& nome = ladder.lastNome();
    const Real difference = sqrt(rest_ / (1 + last_.upper * x_));  // (E − Z)/(1 − Q(E² + Z²))
    const Real sum = sqrt((rest_ + last_.gap * x_) / (1 + last_.lower * x_));  // (E + Z)/(1 + Q(E² + Z²))
    Real squares = sum * sum - 2 * nome;                                       // E² + Z²
    for (int i = 0; i < 2; ++i) {
      squares = square(Real(sum * (1 + nome * squares))) - 2 * nome;
    }
    return ladder.atTop((sum * (1 + nome * squares) + difference * (1 - nome * squares)) / 2);
  }

 private:
  struct Point {
    Real x, rest;  // rest = 1 − aₙ x
  };
  struct Bounds {
    Real upper, lower, gap;
  };
  Real x_;
  Real rest_;
  Point below_{x_, rest_};
  Bounds last_{};
};

/// The mean over a period of (α cn² + β p sn²)/(cn² + p sn²), p > 0, given as s = a₀√p, α and β: Bulirsch's
/// cel(kc, p, α, βp) / K. For positive α and β every term is positive and nothing cancels.
///
/// A step is s ← (s + ab/s)/2, α ← (α + γ/s)/2, γ ← (γ + α ab/s)/2 with γ = βs at first; the mean is V = (αM
/// + γ)/(M + s) once a = b = M. Where ab = M² + ε with a small ε, the V before the step needs only the
/// correction ε (α − V)/((M + s)² + ε), for which `Real` suffices: used for the last step.
template <class Real, class Number = Wide<Real>>
class ThirdKindMean {
 public:
  /// product = a₀ b₀: takes the first step.
  ThirdKindMean(const Number& s, const Number& alpha, const Number& beta, const Number& product) {
    const Number ratio = product / s;
    gamma_ = half(Number(s * beta + alpha * ratio));
    alpha_ = half(Number(alpha + beta));
    s_ = half(Number(s + ratio));
  }

  /// An intermediate step.
  void step(const Number& product) {
    const Real inverse = leadingInverse<Real>(s_);
    const Number ratio = quotient(product, s_, inverse);
    const Number fraction = quotient(gamma_, s_, inverse);
    gamma_ = half(Number(gamma_ + alpha_ * ratio));
    alpha_ = half(Number(alpha_ + fraction));
    s_ = half(Number(s_ + ratio));
  }

  /// Applies the last step.
  template <class Ladder>
  Number value(const Ladder& ladder) const {
    const Number mean = ladder.mean();
    const Number sum = mean + s_;
    const Number circular = (alpha_ * mean + gamma_) / sum;
    const Real excess = ladder.excessOfLastProduct();
    return circular +
           Number(excess * static_cast<Real>(alpha_ - circular) / (square(static_cast<Real>(sum)) + excess));
  }

 private:
  Number s_;
  Number alpha_;
  Number gamma_;
};

}  // namespace careen
