#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/math/elementary.h"
#include "core/math/to_integer.h"
#include "physics/attitude/cayley_klein.h"
#include "physics/attitude/linear_phase.h"

namespace careen {

/// Tilt of a torque-free body during precession: α = θ₄(v + iσ | q²), β = −i θ₁(v + iσ | q²), not normalised.
///
/// v = πu/2K [rad] is the phase of the polhode, q the nome, and σ determines the mean tilt through ε =
/// exp(−πw/2K) and ζ = q/ε = exp(−πs/K)·ε, where w + s = K' and σ = πs/2K (torque_free_rotation.h). Harmonic
/// j of the series has the coefficients q^{j(j−1)/2} ζʲ for e^{ijv} and q^{j(j−1)/2} εʲ for e^{−ijv}, which
/// stay finite for a symmetric body, where q = ζ = 0 and only β = ε e^{−iv} is left.
///
/// Near the separatrix q tends to 1 and the series does not converge in practice. Beyond q = 0.2 Jacobi's
/// imaginary transformation is used: with p = exp(−πK/2K'), y = vK/2K' and x = πs/4K',
///
///     α = θ₂(x − iy | p) e^{iψ},   β = θ₁(x − iy | p) e^{iψ},   ψ = −2xv/π,   for |v| ≤ π/2,
///
/// with whole half turns of v added by α(v + π) = α(v), β(v + π) = −β(v). On the separatrix itself K is
/// infinite, p and ψ vanish, y = u/2 grows without bound, and one term of each series is the exact result.
template <class Real>
class TiltSeries {
 public:
  struct Lean {
    CayleyKlein<Real> spinor;  // up to a common real factor
    Real phase;                // ψ [quarter turns], phase still to be applied to both
  };

  /// No tilt: a spin about the axis itself.
  TiltSeries() : TiltSeries(fromNome(0, 0)) {}

  /// q ≤ 0.2; ε ≥ √q.
  static TiltSeries fromNome(const Real& q, const Real& epsilon) {
    TiltSeries series{Mode::kDirect};
    const Real zeta = epsilon > 0 ? Real(q / epsilon) : Real(0);
    Real epsilonPower = 1;  // q^{j(j−1)/2} εʲ
    Real zetaPower = 1;
    Real nomePower = 1;  // qʲ
    Real sign = 1;       // (−1)ⁿ for the harmonics 2n and 2n + 1
    for (std::size_t n = 0; n < kTerms; ++n) {
      if (n > 0) {
        epsilonPower *= nomePower * epsilon;
        zetaPower *= nomePower * zeta;
        nomePower *= q;
      }
      Harmonic& harmonic = series.harmonics_[n];
      harmonic.alphaCos = n == 0 ? Real(1) : Real(sign * (zetaPower + epsilonPower));
      harmonic.alphaSin = sign * (zetaPower - epsilonPower);
      epsilonPower *= nomePower * epsilon;
      zetaPower *= nomePower * zeta;
      nomePower *= q;
      harmonic.betaCos = sign * (epsilonPower - zetaPower);
      harmonic.betaSin = -sign * (epsilonPower + zetaPower);
      sign = -sign;
    }
    return series;
  }

  /// p = exp(−πK/2K'), x = πs/4K' [rad], stretch = K/2K'.
  static TiltSeries fromComplementaryNome(const Real& p, const Real& x, const Real& stretch) {
    TiltSeries series{Mode::kTransformed};
    series.nome_ = p;
    series.stretch_ = stretch;
    series.phasePerAngle_ = -4 * x / square(elementary::pi<Real>());
    series.setTransformed(p, x);
    return series;
  }

  /// K = ∞: the angle passed to transformed() is then y = u/2 itself.
  static TiltSeries onSeparatrix(const Real& x) {
    TiltSeries series{Mode::kSeparatrix};
    series.setTransformed(0, x);
    return series;
  }

  /// Whether direct() or transformed() gives α and β.
  bool isDirect() const { return mode_ == Mode::kDirect; }

  /// α and β for sin v and cos v.
  CayleyKlein<Real> direct(const elementary::SinCos<Real>& v) const {
    // Clenshaw's recurrence in 2 cos 2v for all four sums in parallel.
    const Real sin2 = 2 * v.sin * v.cos;
    const Real cos2 = (v.cos - v.sin) * (v.cos + v.sin);
    const Real twice = 2 * cos2;
    Harmonic next = harmonics_[kTerms - 1];
    Harmonic afterNext{0, 0, 0, 0};
    for (std::size_t n = kTerms - 1; n-- > 0;) {
      const Harmonic& h = harmonics_[n];
      const Harmonic sum = {h.alphaCos + (twice * next.alphaCos - afterNext.alphaCos),
                            h.alphaSin + (twice * next.alphaSin - afterNext.alphaSin),
                            h.betaCos + (twice * next.betaCos - afterNext.betaCos),
                            h.betaSin + (twice * next.betaSin - afterNext.betaSin)};
      afterNext = next;
      next = sum;
    }
    return {next.alphaCos - cos2 * afterNext.alphaCos, sin2 * afterNext.alphaSin,
            v.cos * (next.betaCos - afterNext.betaCos), v.sin * (next.betaSin + afterNext.betaSin)};
  }

  /// α, β and ψ for v.
  Lean transformed(const TurnedAngle<Real>& angle) const {
    using std::abs;
    // v minus whole half turns; on the separatrix with all of them.
    Real quarters = angle.quarterTurns;
    bool odd = false;
    if (mode_ == Mode::kTransformed) {
      const auto count = toInteger<std::int64_t>(angle.quarterTurns, std::int64_t{0});
      const std::int64_t left = count % 2 == 0 ? 0 : angle.rest > 0 ? -1 : 1;
      quarters = static_cast<Real>(left);
      odd = (count - left) / 2 % 2 != 0;
    }
    const Real v = quarters * (elementary::pi<Real>() / 2) + angle.rest;
    const Real y = v * stretch_;
    // Everything is divided by e^{|y|}/2. As |y| ≤ πK/4K', the growth ratio of successive harmonics is at
    // most 1, also where both numbers underflow.
    const Real decay = elementary::exp(Real(-2 * abs(y)));
    const Real ratio = decay > nome_ ? Real(nome_ / decay) : Real(1);  // p e^{2|y|}
    CayleyKlein<Real> sum{0, 0, 0, 0};
    Real growth = 1;     // ratioⁿ
    Real power = decay;  // e^{−2(2n+1)|y|}
    for (const Harmonic& harmonic : harmonics_) {
      const Real cosh = growth * (1 + power);
      const Real sinh = growth * (1 - power);
      sum.alphaRe += harmonic.alphaCos * cosh;
      sum.alphaIm += harmonic.alphaSin * sinh;
      sum.betaRe += harmonic.betaCos * cosh;
      sum.betaIm += harmonic.betaSin * sinh;
      growth *= ratio;
      power *= decay * decay;
    }
    if (y < 0) {
      sum.alphaIm = -sum.alphaIm;
      sum.betaIm = -sum.betaIm;
    }
    if (odd) {
      sum.betaRe = -sum.betaRe;
      sum.betaIm = -sum.betaIm;
    }
    return {sum, phasePerAngle_ * v};
  }

 private:
  enum class Mode { kDirect, kTransformed, kSeparatrix };

  /// Coefficients of the real and imaginary parts of α (even harmonic) and β (odd harmonic).
  struct Harmonic {
    Real alphaCos, alphaSin, betaCos, betaSin;
  };

  explicit TiltSeries(Mode mode) : mode_(mode) {}

  void setTransformed(const Real& p, const Real& x) {
    Real sign = 1;
    Real weight = 1;  // p^{n²}
    Real nomePower = p;
    for (std::size_t n = 0; n < kTerms; ++n) {
      const elementary::SinCos<Real> angle = elementary::sinCos(Real((2 * static_cast<int>(n) + 1) * x));
      harmonics_[n] = {weight * angle.cos, weight * angle.sin, sign * weight * angle.sin,
                       -sign * weight * angle.cos};
      weight *= nomePower;
      nomePower *= p * p;
      sign = -sign;
    }
  }

  /// Number of terms per sum, such that the first omitted harmonic is below rounding at q = 0.2.
  static constexpr std::size_t countTerms() {
    int j = 1;
    while (1.16 * j * (j - 1) < std::numeric_limits<Real>::digits + 4) {
      ++j;
    }
    return static_cast<std::size_t>((j + 1) / 2);
  }
  static constexpr std::size_t kTerms = countTerms();

  Mode mode_;
  Real nome_ = 0;           // p [1]
  Real stretch_ = 1;        // [1]
  Real phasePerAngle_ = 0;  // [quarter turns/rad]
  std::array<Harmonic, kTerms> harmonics_;
};

}  // namespace careen
