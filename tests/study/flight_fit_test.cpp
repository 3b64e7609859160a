#include "study/flight_fit.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "core/math/pose_difference.h"
#include "physics/motion/motion.h"
#include "support/input_error.h"

namespace careen {
namespace {

constexpr double kRateOfFlight = 148;  // [1/s]
const Vec3 kGravityOfFlight(0, 0, -9.81);

/// A box of random size and motion, measured with noise.
struct MeasuredFlight {
  MassProperties mass;
  BodyState start;
  Vec3 spin = Vec3::Zero();
  std::vector<double> times;
  std::vector<Vec3> positions;
  std::vector<Quat> attitudes;

  MeasuredFlight(std::mt19937_64& random, int rows, double positionNoise, double attitudeNoise) {
    std::uniform_real_distribution<double> number(-1, 1);
    std::normal_distribution<double> normal;
    const auto vector = [&](auto& from) -> Vec3 { return {from(random), from(random), from(random)}; };
    mass = solidBox(Vec3(0.05, 0.06, 0.08) + 0.02 * vector(number), 0.4);
    start.pose.position = vector(number);
    start.pose.worldFromBody =
        Quat(normal(random), normal(random), normal(random), normal(random)).normalized().toRotationMatrix();
    start.velocity = 2 * vector(number);
    spin = 8 * vector(number);
    start.angularMomentum = angularMomentum(mass, start.pose.worldFromBody, spin);
    Flight flight;
    flight.position = start.pose.position;
    flight.velocity = start.velocity;
    flight.acceleration = kGravityOfFlight;
    flight.worldFromBody = Quat(start.pose.worldFromBody);
    flight.angularMomentum = start.angularMomentum;
    for (int k = 0; k < rows; ++k) {
      const double time = k / kRateOfFlight;
      const Pose pose = stateAt(flight, mass, time).pose;
      const Vec3 turn = attitudeNoise * vector(normal);
      times.push_back(time);
      positions.push_back(pose.position + positionNoise * vector(normal));
      attitudes.push_back(
          (Quat(1, turn.x() / 2, turn.y() / 2, turn.z() / 2) * Quat(pose.worldFromBody)).normalized());
      if (random() % 2 == 0) {
        attitudes.back().coeffs() = -attitudes.back().coeffs();
      }
    }
  }
  FlightFit fit() const {
    return fitFlight(mass, kGravityOfFlight,
                     {.times = times, .positions = positions, .attitudes = attitudes});
  }
};

TEST(FlightFit, ofExactPosesIsTheirFlight) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const MeasuredFlight measured(random, 30, 0, 0);
    const FlightFit fit = measured.fit();
    EXPECT_LT((fit.start.pose.position - measured.start.pose.position).norm(), 1e-14);
    EXPECT_LT((fit.start.velocity - measured.start.velocity).norm(), 1e-12);
    EXPECT_LT(angleBetween(fit.start.pose.worldFromBody, measured.start.pose.worldFromBody), 1e-10);
    EXPECT_LT((fit.spin - measured.spin).norm(), 1e-8);
    EXPECT_LT(fit.positionNoise, 1e-14);
    EXPECT_LT(fit.attitudeNoise, 1e-10);
  }
}

// Errors in units of their own estimated deviations have a mean square of 1, if these are right.
TEST(FlightFit, knowsHowWellItKnows) {
  std::mt19937_64 random(2);
  constexpr int kTrials = 400;
  double position = 0;
  double velocity = 0;
  double noise = 0;
  double turning = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const MeasuredFlight measured(random, 40, 55e-6, 0.44e-3);
    const FlightFit fit = measured.fit();
    position += (fit.start.pose.position - measured.start.pose.position).squaredNorm() / 3 /
                (fit.linear[0] * fit.linear[0]) / kTrials;
    velocity += (fit.start.velocity - measured.start.velocity).squaredNorm() / 3 /
                (fit.linear[1] * fit.linear[1] + fit.linear[2] * fit.linear[2]) / kTrials;
    noise += fit.positionNoise / 55e-6 / kTrials;
    turning += fit.attitudeNoise / 0.44e-3 / kTrials;
  }
  EXPECT_NEAR(position, 1, 0.15);  // of 1200 normal deviates: 1 ± 0.04, and of the noise of each trial
  EXPECT_NEAR(velocity, 1, 0.15);
  EXPECT_NEAR(noise, 1, 0.02);
  EXPECT_NEAR(turning, 1, 0.02);
}

// Starts that are drawn scatter as the fits of repeated measurements do.
TEST(FlightFit, drawnStartsScatterAsMeasurementsDo) {
  std::mt19937_64 random(3);
  const MeasuredFlight measured(random, 40, 55e-6, 0.44e-3);
  const FlightFit fit = measured.fit();
  constexpr int kDraws = 4000;
  Vec3 spins = Vec3::Zero();
  double velocities = 0;
  double turns = 0;
  for (int k = 0; k < kDraws; ++k) {
    const BodyState drawn = startNear(fit, measured.mass, random);
    velocities += (drawn.velocity - fit.start.velocity).squaredNorm() / 3 / kDraws;
    turns += std::pow(angleBetween(drawn.pose.worldFromBody, fit.start.pose.worldFromBody), 2) / kDraws;
    spins += (angularVelocity(measured.mass, drawn) - fit.spin).cwiseAbs2() / kDraws;
  }
  const auto sumOfSquares = [&](std::size_t row) {
    double sum = 0;
    for (std::size_t column = 0; column < 6; ++column) {
      sum += std::pow(fit.angular.at(row * 6 + column), 2);
    }
    return sum;
  };
  EXPECT_NEAR(velocities / (std::pow(fit.linear[1], 2) + std::pow(fit.linear[2], 2)), 1, 0.1);
  EXPECT_NEAR(turns / (sumOfSquares(0) + sumOfSquares(1) + sumOfSquares(2)), 1, 0.1);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(spins[static_cast<Eigen::Index>(axis)] / sumOfSquares(3 + axis), 1, 0.1);
  }
}

TEST(FlightFit, tooFewRowsAreRefused) {
  std::mt19937_64 random(4);
  const MeasuredFlight measured(random, 3, 0, 0);
  EXPECT_EQ(inputErrorOf([&] { measured.fit(); }),
            "found 3 poses in free flight, expected at least 4 to fit");
}

TEST(FlightFit, rotationsAreTheShorterWayRound) {
  const Quat turned(Eigen::AngleAxisd(0.3, Vec3::UnitZ()));
  EXPECT_LT((rotationBetween(Quat::Identity(), turned) - Vec3(0, 0, 0.3)).norm(), 1e-15);
  EXPECT_LT((rotationBetween(Quat::Identity(), Quat(-turned.coeffs())) - Vec3(0, 0, 0.3)).norm(), 1e-15);
  EXPECT_EQ(rotationBetween(turned, turned), Vec3::Zero());
}

}  // namespace
}  // namespace careen
