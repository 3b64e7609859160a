#include "physics/attitude/landen_ladder.h"

#include <gtest/gtest.h>

#include <boost/math/special_functions/ellint_1.hpp>
#include <cmath>

#include "support/quad.h"
#include "support/tumbling_box.h"

namespace careen {
namespace {

// Arithmetic-geometric mean, as it stands in the books.
Quad meanOf(Quad a, Quad b) {
  for (int i = 0; i < 40; ++i) {
    const Quad arithmetic = (a + b) / 2;
    b = sqrt(a * b);
    a = arithmetic;
  }
  return a;
}

/// A modulus by its complementary one, and the quantities that go with it.
struct Modulus {
  explicit Modulus(double complementary)
      : kc(complementary),
        k(sqrt((1 - kc) * (1 + kc))),
        quarter(quadPi() / (2 * meanOf(1, kc))),
        otherQuarter(quadPi() / (2 * meanOf(1, k))),
        nome(exp(-quadPi() * otherQuarter / quarter)) {}
  Quad kc, k;
  Quad quarter, otherQuarter;  // K, K'
  Quad nome;

  LandenLadder<double> ladder(double scale = 1) const {
    return {DoubleDouble(scale), DoubleDouble(scale * static_cast<double>(kc)),
            static_cast<double>(Quad(scale) * (1 - kc))};
  }
};

double relativeError(double got, const Quad& exact) {
  return std::fabs(static_cast<double>(Quad(got) / exact - 1));
}

// The last level leaves out d²/16M² = 4ℓ⁴ of the mean, with ℓ³ ≤ 2⁻⁵²/4096 there: 8e-26.
TEST(LandenLadder, meanIsThatOfGaussBeyondTheDigitsOfADouble) {
  test::Dice dice(1);
  for (int k = 0; k < 500; ++k) {
    const double a = dice.between(1, 4);
    const double b = a * std::ldexp(dice.between(0.5, 1), -(k % 60));
    LandenLadder<double> ladder(DoubleDouble(a), DoubleDouble(b), a - b);
    while (ladder.descend()) {
    }
    const Quad exact = meanOf(a, b);
    EXPECT_LT(static_cast<double>(abs(quadOf(ladder.mean()) / exact - 1)), 1e-25)
        << a << ' ' << b;  // measured 5e-26
  }
}

TEST(LandenLadder, nomeIsTheExponentialOfTheQuotientOfThePeriods) {
  for (const double kc : {1e-150, 1e-20, 1e-6, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99}) {
    const Modulus modulus(kc);
    LandenLadder<double> ladder = modulus.ladder(3);
    while (ladder.descend()) {
    }
    // Near 1 the nome's own digits say little: what counts there is 1 − q, of which rounding takes a part.
    EXPECT_LT(relativeError(ladder.nome(), modulus.nome), 1e-15) << kc;
  }
}

// q = (gap/8)(1 + …) for a small gap, which no subtraction of b from a could tell.
TEST(LandenLadder, keepsTheDigitsOfAModulusThatIsNearlyCircular) {
  for (const double gap : {1e-9, 1e-18, 1e-40, 1e-100}) {
    LandenLadder<double> ladder(DoubleDouble(1), DoubleDouble(1) - DoubleDouble(gap), gap);
    while (ladder.descend()) {
    }
    EXPECT_NEAR(ladder.nome() / (gap / 8), 1, 1e-8 * (gap > 1e-10 ? 1 : 1e-7)) << gap;
  }
}

double phaseOf(const Modulus& modulus, double cotangent) {
  LandenLadder<double> ladder = modulus.ladder();
  EllipticPhase<double> phase(cotangent);
  for (bool more = true; more;) {
    more = ladder.descend();
    phase.step(ladder.level());
  }
  return phase.value(static_cast<double>(ladder.mean()));
}

// cs(K/2) = √kc, cs(K) = 0, cs(3K/2) = −√kc.
TEST(LandenLadder, phaseOfHalvesOfTheQuarterPeriodIsInEighthsOfATurn) {
  for (const double kc : {1e-12, 1e-3, 0.2, 0.6, 0.95}) {
    const Modulus modulus(kc);
    const double pi = static_cast<double>(quadPi());
    EXPECT_NEAR(phaseOf(modulus, std::sqrt(kc)), pi / 4, 1e-15) << kc;
    EXPECT_NEAR(phaseOf(modulus, 0), pi / 2, 1e-15) << kc;
    EXPECT_NEAR(phaseOf(modulus, -std::sqrt(kc)), 3 * pi / 4, 2e-15) << kc;
  }
}

// u = F(φ, k) with cot φ = cs u, and what lies beyond K by symmetry.
TEST(LandenLadder, phaseIsTheIncompleteIntegral) {
  test::Dice dice(2);
  for (int k = 0; k < 60; ++k) {
    const Modulus modulus(dice.between(0.1, 0.99));
    const double phi = dice.between(0.05, 1.5);
    const Quad u = boost::math::ellint_1(modulus.k, Quad(phi));
    const double exact = static_cast<double>(quadPi() / 2 * u / modulus.quarter);
    const double cotangent = std::cos(phi) / std::sin(phi);
    EXPECT_NEAR(phaseOf(modulus, cotangent), exact, 4e-15);
    EXPECT_NEAR(phaseOf(modulus, -cotangent), static_cast<double>(quadPi()) - exact, 4e-15);
  }
}

double decayOf(const Modulus& modulus, double sine, double oneMinusSine) {
  LandenLadder<double> ladder = modulus.ladder();
  EllipticDecay<double> decay(sine, oneMinusSine);
  for (bool more = true; more;) {
    more = ladder.descend();
    decay.step(ladder.level());
  }
  return decay.value(ladder);
}

// sn(0) = 0, sn(K'/2, k') = 1/√(1 + k), sn(K', k') = 1: the decay is 1, q^¼, q^½.
TEST(LandenLadder, decayOfHalvesOfTheOtherQuarterPeriodIsARootOfTheNome) {
  for (const double kc : {0.2, 0.5, 0.8, 0.99}) {
    const Modulus modulus(kc);
    EXPECT_NEAR(decayOf(modulus, 0, 1), 1, 2e-15) << kc;
    const Quad sine = 1 / sqrt(1 + modulus.k);
    EXPECT_LT(relativeError(decayOf(modulus, static_cast<double>(sine), static_cast<double>(1 - sine)),
                            sqrt(sqrt(modulus.nome))),
              2e-15)
        << kc;
    EXPECT_LT(relativeError(decayOf(modulus, 1, 0), sqrt(modulus.nome)), 2e-15) << kc;
  }
}

TEST(LandenLadder, decayIsTheExponentialOfTheIncompleteIntegral) {
  test::Dice dice(3);
  for (int k = 0; k < 60; ++k) {
    const Modulus modulus(dice.between(0.1, 0.95));
    const double phi = dice.between(0.05, 1.5);
    const Quad w = boost::math::ellint_1(modulus.kc, Quad(phi));
    const Quad exact = exp(-quadPi() / 2 * w / modulus.quarter);
    const double sine = std::sin(phi);
    const double half = std::sin((std::asin(1.0) - phi) / 2);
    EXPECT_LT(relativeError(decayOf(modulus, sine, 2 * half * half), exact), 4e-15);
  }
}

// The integrands are periodic and analytic, so the trapezoidal rule has all digits.
TEST(LandenLadder, meanOfTheThirdKindIsThatOfItsIntegrand) {
  test::Dice dice(4);
  for (int k = 0; k < 30; ++k) {
    const Modulus modulus(dice.between(0.2, 0.98));
    const double p = dice.between(1, 2);
    const double alpha = dice.between(0.5, 2);
    const double beta = dice.between(0.5, 2);
    constexpr int kPoints = 400;
    Quad sum = 0;
    Quad weights = 0;
    for (int i = 0; i < kPoints; ++i) {
      const Quad sine = sin(quadPi() * i / kPoints);
      const Quad s2 = sine * sine;
      const Quad c2 = 1 - s2;
      const Quad weight = 1 / sqrt(1 - modulus.k * modulus.k * s2);
      sum += weight * (Quad(alpha) * c2 + Quad(beta) * Quad(p) * s2) / (c2 + Quad(p) * s2);
      weights += weight;
    }
    LandenLadder<double> ladder = modulus.ladder();
    ThirdKindMean<double> mean(sqrt(DoubleDouble(p)), DoubleDouble(alpha), DoubleDouble(beta),
                               ladder.product());
    for (bool more = true, isFirst = true; more; isFirst = false) {
      more = ladder.descend();
      if (more && !isFirst) {
        mean.step(ladder.product());
      }
    }
    EXPECT_LT(static_cast<double>(abs(quadOf(mean.value(ladder)) / (sum / weights) - 1)), 1e-28);
  }
}

// Multiplying both by a power of two multiplies the mean and leaves the nome alone, to the bit.
TEST(LandenLadder, isHomogeneous) {
  test::Dice dice(5);
  for (int k = 0; k < 200; ++k) {
    const Modulus modulus(dice.between(0.001, 1));
    LandenLadder<double> one = modulus.ladder();
    LandenLadder<double> large = modulus.ladder(0x1p40);
    bool more = true;
    while (more) {
      more = one.descend();
      EXPECT_EQ(large.descend(), more);
    }
    EXPECT_EQ(large.nome(), one.nome());
    EXPECT_EQ(large.mean().hi, 0x1p40 * one.mean().hi);
    EXPECT_EQ(large.mean().lo, 0x1p40 * one.mean().lo);
  }
}

}  // namespace
}  // namespace careen
