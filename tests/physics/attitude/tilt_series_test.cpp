#include "physics/attitude/tilt_series.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "support/quad.h"
#include "support/tumbling_box.h"

namespace careen {
namespace {

elementary::SinCos<Quad> sinCosOf(const Quad& v) { return {sin(v), cos(v)}; }

/// θ₄(v + iσ | q²) and −i θ₁(v + iσ | q²) from the series of the books, in q and σ.
CayleyKlein<Quad> thetas(const Quad& q, const Quad& v, const Quad& sigma) {
  CayleyKlein<Quad> sum{1, 0, 0, 0};
  Quad sign = 1;
  for (int n = 0; n < 20; ++n) {
    // θ₁ = 2 Σ (−1)ⁿ Q^{(n+½)²} sin (2n+1)z, sin(x + iy) = sin x cosh y + i cos x sinh y, times −i.
    const int odd = 2 * n + 1;
    const Quad one = 2 * sign * pow(q, Quad(odd * odd) / 2);
    sum.betaRe += one * cos(odd * v) * sinh(odd * sigma);
    sum.betaIm -= one * sin(odd * v) * cosh(odd * sigma);
    // θ₄ = 1 + 2 Σ (−1)ⁿ Q^{n²} cos 2nz, cos(x + iy) = cos x cosh y − i sin x sinh y.
    sign = -sign;
    const int even = 2 * (n + 1);
    const Quad four = 2 * sign * pow(q, Quad(even * even) / 2);
    sum.alphaRe += four * cos(even * v) * cosh(even * sigma);
    sum.alphaIm -= four * sin(even * v) * sinh(even * sigma);
  }
  return sum;
}

double distance(const CayleyKlein<Quad>& a, const CayleyKlein<Quad>& b) {
  const Quad alpha = abs(a.alphaRe - b.alphaRe) + abs(a.alphaIm - b.alphaIm);
  const Quad beta = abs(a.betaRe - b.betaRe) + abs(a.betaIm - b.betaIm);
  return static_cast<double>(alpha + beta);
}

CayleyKlein<Quad> wide(const CayleyKlein<double>& a) { return {a.alphaRe, a.alphaIm, a.betaRe, a.betaIm}; }

CayleyKlein<Quad> ofUnitLength(const CayleyKlein<Quad>& a) {
  const Quad scale = 1 / sqrt(squaredNorm(a));
  return {scale * a.alphaRe, scale * a.alphaIm, scale * a.betaRe, scale * a.betaIm};
}

// ε = √q e^σ, with 0 ≤ σ < ½ ln(1/q).
TEST(TiltSeries, directIsTheTwoThetaFunctions) {
  test::Dice dice(1);
  for (int k = 0; k < 300; ++k) {
    const double q = dice.between(0.001, 0.2);
    const double epsilon = std::sqrt(q) * std::pow(q, -0.5 * dice.between(0, 0.99));
    const Quad v = Quad(dice.between(-6, 6));
    const Quad sigma = log(Quad(epsilon) / sqrt(Quad(q)));
    const CayleyKlein<Quad> exact = thetas(q, v, sigma);
    const TiltSeries<Quad> series = TiltSeries<Quad>::fromNome(q, epsilon);
    EXPECT_TRUE(series.isDirect());
    EXPECT_LT(distance(series.direct(sinCosOf(v)), exact), 1e-31);
    const elementary::SinCos<double> plain{static_cast<double>(sin(v)), static_cast<double>(cos(v))};
    EXPECT_LT(distance(wide(TiltSeries<double>::fromNome(q, epsilon).direct(plain)), exact), 4e-15);
  }
}

// A symmetric body leans by a fixed angle: α = 1, β = ε e^{−iv}. One that leans not at all: β = 0.
TEST(TiltSeries, ofASymmetricBodyIsASingleTerm) {
  const double v = 0.7;
  const elementary::SinCos<double> angle{std::sin(v), std::cos(v)};
  const CayleyKlein<double> lean = TiltSeries<double>::fromNome(0, 0.5).direct(angle);
  EXPECT_EQ(lean.alphaRe, 1);
  EXPECT_EQ(lean.alphaIm, 0);
  EXPECT_NEAR(lean.betaRe, 0.5 * std::cos(v), 1e-16);
  EXPECT_NEAR(lean.betaIm, -0.5 * std::sin(v), 1e-16);
  EXPECT_EQ(squaredNorm(TiltSeries<double>().direct(angle)), 1);
}

// Jacobi's imaginary transformation: where both series hold they tell one attitude, up to a factor.
TEST(TiltSeries, bothSeriesTellTheSameLean) {
  test::Dice dice(2);
  for (int k = 0; k < 300; ++k) {
    const Quad q(dice.between(0.1, 0.2));
    const Quad quotient = -log(q) / quadPi();  // K'/K
    const Quad part(dice.between(0, 0.99));   // s/K'
    const Quad epsilon = exp(-quadPi() * quotient * (1 - part) / 2);
    const TiltSeries<Quad> direct = TiltSeries<Quad>::fromNome(q, epsilon);
    const TiltSeries<Quad> other = TiltSeries<Quad>::fromComplementaryNome(
        exp(-quadPi() / (2 * quotient)), quadPi() * part / 4, 1 / (2 * quotient));
    EXPECT_FALSE(other.isDirect());
    // Up to three half turns either way.
    const int quarters = static_cast<int>(std::floor(dice.between(-6, 7)));
    const Quad rest(dice.between(-0.78, 0.78));
    const Quad v = quarters * quadPi() / 2 + rest;
    const auto lean = other.transformed({Quad(quarters), rest});
    const elementary::SinCos<Quad> phase = sinCosOf(Quad(lean.phase * quadPi() / 2));
    const CayleyKlein<Quad> got = product<Quad>({phase.cos, phase.sin, 0, 0}, lean.spinor);
    EXPECT_LT(distance(ofUnitLength(got), ofUnitLength(direct.direct(sinCosOf(v)))), 1e-30)
        << q << ' ' << quarters;
  }
}

// K = ∞: α = cos(x − iy), β = sin(x − iy), divided by e^{|y|}/2.
TEST(TiltSeries, onTheSeparatrixIsASingleTermHoweverLongItLasts) {
  const double x = 0.4;
  const TiltSeries<double> series = TiltSeries<double>::onSeparatrix(x);
  for (const double y : {-1.3, 0.0, 0.7, 2.0}) {
    const double quarters = std::round(y / std::asin(1.0));
    const auto lean = series.transformed({quarters, y - quarters * std::asin(1.0)});
    const double scale = 2 * std::exp(-std::fabs(y));
    EXPECT_EQ(lean.phase, 0);
    EXPECT_NEAR(lean.spinor.alphaRe, scale * std::cos(x) * std::cosh(y), 1e-15);
    EXPECT_NEAR(lean.spinor.alphaIm, scale * std::sin(x) * std::sinh(y), 1e-15);
    EXPECT_NEAR(lean.spinor.betaRe, scale * std::sin(x) * std::cosh(y), 1e-15);
    EXPECT_NEAR(lean.spinor.betaIm, -scale * std::cos(x) * std::sinh(y), 1e-15);
  }
  // In the end tan x stays of it: the spin about the middle axis.
  const auto late = series.transformed({200, 0});
  EXPECT_NEAR(late.spinor.alphaRe, std::cos(x), 1e-15);
  EXPECT_NEAR(late.spinor.betaIm, -std::cos(x), 1e-15);
}

}  // namespace
}  // namespace careen
