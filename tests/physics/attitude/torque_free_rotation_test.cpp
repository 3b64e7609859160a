#include "physics/attitude/torque_free_rotation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "support/free_bodies.h"
#include "support/quad.h"
#include "support/taylor_oracle.h"
#include "support/without_traps.h"

// The oracle is a Taylor series of order 30 (support/taylor_oracle.h). In bulk it runs in long double, 64
// bits and 2000 times finer than what is tested; where more is tested, in quadruple precision. Errors are
// rotation angles divided by 1 + ωt, ω being the largest angular speed of the flight.

namespace careen {
namespace {

using oracle::Draw;
using oracle::FreeBody;
using oracle::Start;
using oracle::StartSource;

template <class Real>
TorqueFreeRotation<Real> rotation(const Start& start) {
  return {start.moments.cast<Real>(), start.attitude.cast<Real>(), start.momentum.cast<Real>()};
}

template <class Real, class OracleReal>
double worstError(Draw kind, int count, double longest) {
  // A series that ends gives the oracle's step size an infinity to swallow.
  const WithoutTraps withoutTraps;
  StartSource source(static_cast<unsigned>(kind) + 1);
  double worst = 0;
  for (int i = 0; i < count; ++i) {
    const Start start = source.draw(kind);
    const TorqueFreeRotation<Real> flight = rotation<Real>(start);
    const double speed = static_cast<double>(flight.bounds().angularSpeed);
    const double t = (source.below(4) == 0 ? -1 : 1) * source.logUniform(1e-2, longest) / speed;
    FreeBody<OracleReal> body = oracle::freeBody<OracleReal>(start);
    oracle::advance(body, OracleReal(t));
    const double error =
        oracle::angleBetween(body, flight.worldFromBody(Real(t))) / (1 + speed * std::fabs(t));
    EXPECT_FALSE(std::isnan(error));
    worst = std::max(worst, error);
  }
  ::testing::Test::RecordProperty(
      "worst", std::to_string(worst * 1e18) + "e-18, " + std::to_string(worst * 1e34) + "e-34");
  return worst;
}

constexpr int kBulk = 34000;  // of each of six kinds: 204,000 in all

TEST(TorqueFreeRotation, followsTheOracleForGenericBoxes) {
  // measured 1.3e-15, asserts < 2e-15
  EXPECT_LT((worstError<double, long double>(Draw::kGeneric, kBulk, 30)), 2e-15);
}

TEST(TorqueFreeRotation, followsTheOracleForNeedlesAndPlates) {
  // measured 1.04e-15, asserts < 2e-15
  EXPECT_LT((worstError<double, long double>(Draw::kExtremeShape, kBulk, 30)), 2e-15);
}

TEST(TorqueFreeRotation, followsTheOracleForNearlySymmetricBodies) {
  // measured 1.06e-15, asserts < 2e-15
  EXPECT_LT((worstError<double, long double>(Draw::kNearSymmetric, kBulk, 30)), 2e-15);
}

TEST(TorqueFreeRotation, followsTheOracleForSymmetricBodiesAndCubes) {
  // measured 1.08e-15, asserts < 2e-15
  EXPECT_LT((worstError<double, long double>(Draw::kSymmetric, kBulk, 30)), 2e-15);
}

// Spin along an axis but for the rounding of the attitude: the other two components are what has cancelled,
// and their squares came out negative once. What spins about its axis keeps to it.
TEST(TorqueFreeRotation, keepsToAnAxisThatOnlyRoundingLeaves) {
  const Vec3 moments(0.0080221269748460347, 0.011037178710746519, 0.0045587477762336912);
  const Quat attitude(0.68577565682161989, -0.17168927073405801, 0.68594664101138902, 0.17237096191318307);
  for (const double size : {1.0, 1e3, 1e6}) {
    const Vec3 momentum =
        size * Vec3(-1.3399907340884674e-05, -7.1733149753299932e-06, 2.4683069478582346e-21);
    const TorqueFreeRotation<double> rotation(moments, attitude, momentum);
    EXPECT_LT((rotation.worldFromBody(0.0).coeffs() - attitude.coeffs()).norm(), 1e-15) << size;
    const Vec3 axis = rotation.worldFromBody(10.0) * Vec3::UnitZ();
    EXPECT_LT((axis + momentum.normalized()).norm(), 1e-14) << size;
  }
}

TEST(TorqueFreeRotation, followsTheOracleForSpinsCloseToAnAxis) {
  // measured 1.05e-15, asserts < 2e-15
  EXPECT_LT((worstError<double, long double>(Draw::kNearAxis, kBulk, 30)), 2e-15);
}

TEST(TorqueFreeRotation, followsTheOracleForSpinsInAPlaneOrAboutAnAxis) {
  // measured 9.3e-16, asserts < 2e-15
  EXPECT_LT((worstError<double, long double>(Draw::kAxis, kBulk, 30)), 2e-15);
}

TEST(TorqueFreeRotation, followsTheOracleCloseToTheSeparatrix) {
  // In quadruple precision: here the oracle's own rounding grows exponentially, to 6e-12 in long double.
  // measured 8.6e-16, asserts < 2e-15
  EXPECT_LT((worstError<double, Quad>(Draw::kNearSeparatrix, 1500, 30)), 2e-15);
}

TEST(TorqueFreeRotation, doesAsWellInLongDouble) {
  // Nothing is kept in twice the digits here, and a spin close to the separatrix or a needle magnifies
  // roundings.
  for (const Draw kind : {Draw::kNearSymmetric, Draw::kSymmetric, Draw::kNearAxis, Draw::kAxis}) {
    // measured 4.3e-19, asserts < 5e-18 (ε = 1.1e-19)
    EXPECT_LT((worstError<long double, Quad>(kind, 60, 30)), 5e-18) << static_cast<int>(kind);
  }
}

TEST(TorqueFreeRotation, doesAsWellInQuadruplePrecision) {
  for (int kind = 0; kind < static_cast<int>(Draw::kNearSeparatrix); ++kind) {
    // measured 4.5e-34, asserts < 1e-31 (ε = 1.9e-34)
    EXPECT_LT((worstError<Quad, Quad>(static_cast<Draw>(kind), 40, 30)), 1e-31) << kind;
  }
}

TEST(TorqueFreeRotation, followsTheOracleOnTheSeparatrix) {
  // Moments 3, 4, 6 and equal momentum along the outer two: D = 0 without rounding.
  double worst = 0;
  for (const double middle : {-2.0, -0.25, 0.0, 0.5, 3.0}) {
    for (const double outer : {1.0, -1.0}) {
      for (const double t : {-20.0, -3.0, -0.1, 0.7, 5.0, 40.0}) {
        const Start start{Vec3(3, 4, 6), Quat::Identity(), Vec3(1, middle, outer)};
        FreeBody<Quad> body = oracle::freeBody<Quad>(start);
        oracle::advance(body, Quad(t));
        const double angle = oracle::angleBetween(body, rotation<double>(start).worldFromBody(t));
        worst = std::max(worst, angle / (1 + oracle::angularSpeedAtStart(start) * std::fabs(t)));
      }
    }
  }
  EXPECT_LT(worst, 2e-15);  // measured 5.7e-16
  ::testing::Test::RecordProperty("worst", std::to_string(worst * 1e18) + "e-18");
}

/// Error of a body that spins about its middle axis but for `off`, until after it has turned over. Later the
/// series does not count, because it has to come back to within `off` of the axis; quadruple precision's own
/// closed form goes on.
double worstErrorNearMiddleAxis(const Vec3& momentum) {
  const WithoutTraps withoutTraps;
  const Start start{Vec3(1, 1.5, 2), Quat::Identity(), momentum};
  const TorqueFreeRotation<double> flight = rotation<double>(start);
  const TorqueFreeRotation<Quad> reference = rotation<Quad>(start);
  const double speed = momentum[1] / 1.5;
  const double lambda = momentum[1] * std::sqrt((1 - 1 / 1.5) * (1 / 1.5 - 1 / 2.0));
  const double turnsOver = std::log(momentum[1] / std::max(momentum[0], momentum[2])) / lambda;
  double worst = 0;
  FreeBody<Quad> body = oracle::freeBody<Quad>(start);
  double reached = 0;
  for (const double t : {0.1, 0.6 * turnsOver, turnsOver, turnsOver + 6 / momentum[1]}) {
    oracle::advance(body, Quad(t) - Quad(reached));
    reached = t;
    const double error = oracle::angleBetween(body, flight.worldFromBody(t)) / (1 + speed * t);
    EXPECT_FALSE(std::isnan(error));
    worst = std::max(worst, error);
  }
  for (int i = -10; i <= 10; ++i) {
    const double t = 100 * i;
    const Quaternion<Quad> q = reference.worldFromBody(t);
    const FreeBody<Quad> later{{}, {}, {q.w(), q.x(), q.y(), q.z()}};
    const double error = oracle::angleBetween(later, flight.worldFromBody(t)) / (1 + speed * std::fabs(t));
    EXPECT_FALSE(std::isnan(error));
    worst = std::max(worst, error);
  }
  EXPECT_NEAR(flight.worldFromBody(1e8).norm(), 1, 1e-15);
  return worst;
}

TEST(TorqueFreeRotation, followsTheOracleForASpinHardlyOffTheMiddleAxis) {
  // K = ln(4/kc) reaches 700 here, kc² would underflow, and so would the smallest of the terms summed.
  double worst = 0;
  for (const double off : {1e-20, 1e-60, 1e-160, 1e-307}) {
    for (const Vec3& momentum :
         {Vec3(off, 1, 0.25 * off), Vec3(off, 7.5, 0), Vec3(0, 7.5, off), Vec3(off, 7.5, off)}) {
      const double error = worstErrorNearMiddleAxis(momentum);
      EXPECT_LT(error, 2e-15) << momentum.transpose();  // measured 4.4e-16
      worst = std::max(worst, error);
    }
  }
  ::testing::Test::RecordProperty("worst", std::to_string(worst * 1e18) + "e-18");
}

TEST(TorqueFreeRotation, endsAboutTheMiddleAxisOnTheSeparatrix) {
  const Start start{Vec3(3, 4, 6), Quat::Identity(), Vec3(1, 0.5, 1)};
  const TorqueFreeRotation<double> flight = rotation<double>(start);
  for (const double t : {1e3, 1e6, 1e9}) {
    const Quat attitude = flight.worldFromBody(t);
    EXPECT_NEAR(std::fabs((attitude.conjugate() * start.momentum)[1]), 1.5, 1e-14);
    EXPECT_NEAR(attitude.norm(), 1, 5e-16);
  }
}

TEST(TorqueFreeRotation, isRightAfterTenThousandSeconds) {
  // The attitude that the oracle in quadruple precision reaches after 10⁴ s (2 to 4 minutes each):
  // oracle::advance(freeBody<Quad>(start), Quad(1e4)).
  struct Case {
    Start start;
    Quat reference;
  };
  const Case cases[] = {
      {{Vec3(0.13, 0.1, 0.05), Quat::Identity(), Vec3(0.13, 0.2, 0.15)},
       Quat(0.538847775369393352, -0.728217214529567396, 0.272990870063698618, 0.323757236682237941)},
      {{Vec3(0.13, 0.1, 0.05), Quat::Identity(), Vec3(0.00390625, 0.125, 0.00390625)},
       Quat(-0.0251691969094260089, 0.832197969351544022, -0.0283273388956693644, -0.553182260385481844)},
      {{Vec3(2, 1.75, 0.375), Quat(0.5, -0.25, 0.75, 1), Vec3(1, -0.5, 0.375)},
       Quat(0.308579332860411334, 0.747745159614346339, 0.456995905169599081, -0.369879323919245298)},
  };
  double worst = 0;
  for (const Case& c : cases) {
    const Quat got = rotation<double>(c.start).worldFromBody(1e4);
    const double sign = got.coeffs().dot(c.reference.coeffs()) < 0 ? -1 : 1;
    worst = std::max(worst, 2 * (got.coeffs() - sign * c.reference.coeffs()).norm());
  }
  EXPECT_LT(worst, 1e-14);  // measured 7.1e-16
  ::testing::Test::RecordProperty("worst", std::to_string(1e18 * worst) + "e-18");
}

/// Twice the time between two passages of the momentum's middle component through zero.
double polhodePeriod(const Vec3& halfEdges, const Vec3& omega, int middle, double longest) {
  const Vec3 squares = halfEdges.cwiseProduct(halfEdges);
  const Vec3 moments = Vec3(squares[1] + squares[2], squares[0] + squares[2], squares[0] + squares[1]) / 3;
  const Vec3 momentum = moments.cwiseProduct(omega);
  const TorqueFreeRotation<double> flight(moments, Quat::Identity(), momentum);
  const auto middleMomentum = [&](double t) {
    return (flight.worldFromBody(t).conjugate() * momentum)[middle];
  };
  std::array<double, 2> zeros{};
  std::size_t found = 0;
  const double step = longest / 4096;
  for (double t = 0.3 * step; t < longest && found < 2; t += step) {
    double low = t;
    double high = t + step;
    if (middleMomentum(low) * middleMomentum(high) < 0) {
      for (int i = 0; i < 60; ++i) {
        const double half = 0.5 * (low + high);
        (middleMomentum(low) * middleMomentum(half) <= 0 ? high : low) = half;
      }
      zeros[found++] = low;
    }
  }
  return 2 * (zeros[1] - zeros[0]);
}

TEST(TorqueFreeRotation, hasTheKnownPolhodePeriods) {
  // 4K/λ with K summed to 60 digits; the error allowed is one in the last digit given.
  EXPECT_NEAR(polhodePeriod({0.1, 0.2, 0.3}, {1, 2, 3}, 1, 8), 3.67184730265, 1e-11);
  EXPECT_NEAR(polhodePeriod({0.1, 0.2, 0.3}, {0.05, 5, 0.05}, 1, 25), 10.2203046143, 1e-10);
  const Vec3 book(0.35, 0.08, 0.5);
  EXPECT_NEAR(polhodePeriod(book, {5, 0.01, 0.01}, 0, 25), 10.5603943411, 1e-10);
  EXPECT_NEAR(polhodePeriod(book, {5, 1e-3, 0}, 0, 30), 13.5336272435, 1e-10);
  EXPECT_NEAR(polhodePeriod(book, {5, 1e-6, 0}, 0, 50), 23.4864286861, 1e-10);
  EXPECT_NEAR(polhodePeriod(book, {5, 1e-9, 0}, 0, 70), 33.4392297930, 1e-10);
}

void expectSameBits(const Quat& a, const Quat& b) {
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(a.coeffs()[i] + 0.0),
              std::bit_cast<std::uint64_t>(b.coeffs()[i] + 0.0));
  }
}

TEST(TorqueFreeRotation, ofAMirroredBodyIsTheMirroredRotationToTheBit) {
  // Mirroring coordinate i turns the axial vectors L and the vector part of q over in the two others.
  StartSource source(97);
  for (int kind = 0; kind < static_cast<int>(Draw::kCount); ++kind) {
    for (int n = 0; n < 300; ++n) {
      const Start start = source.draw(static_cast<Draw>(kind));
      const double t = source.uniform(-30, 30) / oracle::angularSpeedAtStart(start);
      const Quat attitude = rotation<double>(start).worldFromBody(t);
      for (int i = 0; i < 3; ++i) {
        const auto mirrored = [i](const Vec3& v) {
          Vec3 result = -v;
          result[i] = v[i];
          return result;
        };
        const auto mirroredAttitude = [&](const Quat& q) {
          const Vec3 v = mirrored(q.vec());
          return Quat(q.w(), v[0], v[1], v[2]);
        };
        const Start other{start.moments, mirroredAttitude(start.attitude), mirrored(start.momentum)};
        expectSameBits(rotation<double>(other).worldFromBody(t), mirroredAttitude(attitude));
      }
    }
  }
}

TEST(TorqueFreeRotation, isTheSameToTheBitInUnitsThatArePowersOfTwo) {
  StartSource source(2);
  for (int kind = 0; kind < static_cast<int>(Draw::kCount); ++kind) {
    for (int n = 0; n < 300; ++n) {
      const Start start = source.draw(static_cast<Draw>(kind));
      const double t = source.uniform(-30, 30) / oracle::angularSpeedAtStart(start);
      const TorqueFreeRotation<double> flight = rotation<double>(start);
      for (const int a : {-31, 10}) {
        for (const int b : {-18, 7}) {
          const Start other{start.moments * std::ldexp(1, a), start.attitude,
                            start.momentum * std::ldexp(1, b)};
          const TorqueFreeRotation<double> scaled = rotation<double>(other);
          expectSameBits(scaled.worldFromBody(std::ldexp(t, a - b)), flight.worldFromBody(t));
          EXPECT_EQ(scaled.bounds().angularSpeed, std::ldexp(flight.bounds().angularSpeed, b - a));
          EXPECT_EQ(scaled.bounds().angularAcceleration,
                    std::ldexp(flight.bounds().angularAcceleration, 2 * (b - a)));
        }
      }
    }
  }
}

TEST(TorqueFreeRotation, restsWithoutAngularMomentum) {
  const Quat start = Quat(1, 2, 3, 4).normalized();
  const TorqueFreeRotation<double> flight(Vec3(1, 2, 2.5), start, Vec3::Zero());
  EXPECT_LT((flight.worldFromBody(1e6).coeffs() - start.coeffs()).norm(), 3e-16);
  EXPECT_EQ(flight.worldFromBody(1e6).coeffs(), flight.worldFromBody(0).coeffs());
  EXPECT_EQ(flight.angularVelocityWorld(start), Vec3::Zero());
  EXPECT_EQ(flight.bounds().angularSpeed, 0);
  EXPECT_EQ(flight.bounds().angularAcceleration, 0);
}

TEST(TorqueFreeRotation, turnsAtASteadyRateAboutABodyAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 moments(1, 2, 2.5);
    Vec3 momentum = Vec3::Zero();
    momentum[axis] = -3;
    const TorqueFreeRotation<double> flight(moments, Quat::Identity(), momentum);
    const double half = 0.5 * 7 * -3 / moments[axis];
    const Quat attitude = flight.worldFromBody(7);
    EXPECT_NEAR(attitude.w(), std::cos(half), 1e-15);
    EXPECT_NEAR(attitude.vec()[axis], std::sin(half), 1e-15);
  }
}

TEST(TorqueFreeRotation, keepsUnitLengthAndEnergy) {
  StartSource source(5);
  double worstLength = 0;
  double worstEnergy = 0;
  for (int n = 0; n < 20000; ++n) {
    const Start start = source.draw(static_cast<Draw>(n % static_cast<int>(Draw::kCount)));
    const TorqueFreeRotation<double> flight = rotation<double>(start);
    const auto energyAt = [&](const Quat& q) {
      return 0.5 * flight.angularVelocityWorld(q).dot(start.momentum);
    };
    const Quat late = flight.worldFromBody(1e4 * source.uniform(0, 1));
    worstLength = std::max(worstLength, std::fabs(late.norm() - 1));
    const double before = energyAt(start.attitude);
    // A small moment makes energy that much more sensitive to the direction of the spin.
    const double scale = start.momentum.squaredNorm() / start.moments.minCoeff();
    worstEnergy = std::max(worstEnergy, std::fabs(energyAt(late) - before) / scale);
  }
  EXPECT_LT(worstLength, 1e-15);  // measured 5.6e-16
  EXPECT_LT(worstEnergy, 2e-15);  // measured 7.8e-16
  ::testing::Test::RecordProperty(
      "worst", std::to_string(1e18 * worstLength) + " " + std::to_string(1e18 * worstEnergy));
}

TEST(TorqueFreeRotation, angularVelocityAgreesWithTheOracle) {
  StartSource source(11);
  double worst = 0;
  for (int n = 0; n < 2000; ++n) {
    const Start start = source.draw(Draw::kGeneric);
    const TorqueFreeRotation<double> flight = rotation<double>(start);
    const double t = 5 / flight.bounds().angularSpeed;
    FreeBody<long double> body = oracle::freeBody<long double>(start);
    oracle::advance(body, static_cast<long double>(t));
    const Quaternion<long double> q(body.attitude[0], body.attitude[1], body.attitude[2], body.attitude[3]);
    const Vector3<long double> omega(body.momentum[0] / body.moments[0], body.momentum[1] / body.moments[1],
                                     body.momentum[2] / body.moments[2]);
    const Vec3 expected = (q * omega).cast<double>();
    const Vec3 got = flight.angularVelocityWorld(flight.worldFromBody(t));
    worst = std::max(worst, (got - expected).norm() / (start.momentum.norm() / start.moments.minCoeff()));
  }
  EXPECT_LT(worst, 1e-14);  // measured 1.1e-15
  ::testing::Test::RecordProperty("worst", std::to_string(1e18 * worst));
}

TEST(TorqueFreeRotation, boundsHoldAndAreReached) {
  StartSource source(13);
  double loosestSpeed = 1;
  double loosestAcceleration = 1;
  for (int n = 0; n < 700; ++n) {
    const auto kind = static_cast<Draw>(n % static_cast<int>(Draw::kNearSeparatrix));
    const Start start = source.draw(kind);
    const TorqueFreeRotation<double> flight = rotation<double>(start);
    const double speedBound = flight.bounds().angularSpeed;
    const double accelerationBound = flight.bounds().angularAcceleration;
    double speed = 0;
    double acceleration = 0;
    // In long double; what rounding leaves of a zero torque, m × ω for m parallel to ω, is allowed for.
    const double oracleRounding = 1e-18 * std::pow(start.momentum.norm() / start.moments.minCoeff(), 2);
    FreeBody<long double> body = oracle::freeBody<long double>(start);
    for (int i = 0; i < 400; ++i) {
      const auto& m = body.momentum;
      const std::array<long double, 3> w = {m[0] / body.moments[0], m[1] / body.moments[1],
                                            m[2] / body.moments[2]};
      const std::array<long double, 3> a = {(m[1] * w[2] - m[2] * w[1]) / body.moments[0],
                                            (m[2] * w[0] - m[0] * w[2]) / body.moments[1],
                                            (m[0] * w[1] - m[1] * w[0]) / body.moments[2]};
      speed = std::max(speed, static_cast<double>(std::sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2])));
      acceleration =
          std::max(acceleration, static_cast<double>(std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])));
      EXPECT_LE(speed, speedBound);
      EXPECT_LE(acceleration, accelerationBound + oracleRounding);
      oracle::advance<long double, 12>(body, 0.1L / static_cast<long double>(speedBound));
    }
    if (kind == Draw::kGeneric) {
      loosestSpeed = std::min(loosestSpeed, speed / speedBound);
      loosestAcceleration = std::min(loosestAcceleration, acceleration / accelerationBound);
    }
  }
  // A slow polhode is not followed all the way round. Measured 0.999 and 0.86
  EXPECT_GT(loosestSpeed, 0.9);
  EXPECT_GT(loosestAcceleration, 0.5);
  ::testing::Test::RecordProperty("worst",
                                  std::to_string(loosestSpeed) + " " + std::to_string(loosestAcceleration));
}

TEST(TorqueFreeRotation, isASmallValue) {
  static_assert(std::is_trivially_copyable_v<TorqueFreeRotation<double>>);
  EXPECT_LE(sizeof(TorqueFreeRotation<double>), 512U);
}

}  // namespace
}  // namespace careen
