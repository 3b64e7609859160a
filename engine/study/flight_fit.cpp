#include "study/flight_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>

#include "core/error.h"
#include "physics/motion/motion.h"
#include "trajectory/given_run.h"

namespace careen {
namespace {

constexpr int kSix = 6;
constexpr int kMostIterations = 20;
constexpr double kConverged = 1e-13;  // [rad], [rad/s]
constexpr double kDifference = 1e-6;  // of attitude and angular velocity, for the Jacobian

/// Attitude and angular velocity at the start: changes `p` are a rotation vector, then rad/s, world frame.
struct Turning {
  Quat attitude;
  Vec3 spin;

  Turning changedBy(const Eigen::VectorXd& p) const {
    const Vec3 turn = p.head(3);
    const double angle = turn.norm();
    const Quat by = angle > 0 ? Quat(Eigen::AngleAxisd(angle, turn / angle)) : Quat::Identity();
    return {(by * attitude).normalized(), spin + Vec3(p.tail(3))};
  }
};

Flight flightOf(const MassProperties& mass, const Turning& start) {
  Flight flight;
  flight.worldFromBody = start.attitude;
  flight.angularMomentum = angularMomentum(mass, start.attitude.toRotationMatrix(), start.spin);
  return flight;
}

// What is left of each measured attitude.
Eigen::VectorXd residuals(const MassProperties& mass, const Turning& start, const FlightSamples& samples) {
  const Motion motion = flightOf(mass, start);
  Eigen::VectorXd left(3 * static_cast<Eigen::Index>(samples.times.size()));
  for (std::size_t k = 0; k < samples.times.size(); ++k) {
    const Quat predicted(stateAt(motion, mass, samples.times[k]).pose.worldFromBody);
    left.segment(3 * static_cast<Eigen::Index>(k), 3) = rotationBetween(predicted, samples.attitudes[k]);
  }
  return left;
}

Eigen::MatrixXd jacobian(const MassProperties& mass, const Turning& start, const FlightSamples& samples) {
  Eigen::MatrixXd slopes(3 * static_cast<Eigen::Index>(samples.times.size()), kSix);
  for (int column = 0; column < kSix; ++column) {
    const Eigen::VectorXd step = kDifference * Eigen::VectorXd::Unit(kSix, column);
    slopes.col(column) =
        (residuals(mass, start.changedBy(step), samples) - residuals(mass, start.changedBy(-step), samples)) /
        (2 * kDifference);
  }
  return slopes;
}

void fitPositions(const Vec3& acceleration, const FlightSamples& samples, FlightFit& fit) {
  double count = 0;
  double sumT = 0;
  double sumTT = 0;
  Vec3 sumX = Vec3::Zero();
  Vec3 sumTX = Vec3::Zero();
  const auto straight = [&](std::size_t k) -> Vec3 {
    return samples.positions[k] - 0.5 * samples.times[k] * samples.times[k] * acceleration;
  };
  for (std::size_t k = 0; k < samples.times.size(); ++k) {
    const double t = samples.times[k];
    count += 1;
    sumT += t;
    sumTT += t * t;
    sumX += straight(k);
    sumTX += t * straight(k);
  }
  const double determinant = count * sumTT - sumT * sumT;
  fit.start.velocity = (count * sumTX - sumT * sumX) / determinant;
  fit.start.pose.position = (sumX - sumT * fit.start.velocity) / count;
  double squares = 0;
  for (std::size_t k = 0; k < samples.times.size(); ++k) {
    squares += (straight(k) - fit.start.pose.position - samples.times[k] * fit.start.velocity).squaredNorm();
  }
  fit.positionNoise = std::sqrt(squares / (3 * (count - 2)));
  // Covariance σ²/det · (Σt², −Σt; −Σt, n).
  const double scale = fit.positionNoise / std::sqrt(determinant);
  fit.linear[0] = scale * std::sqrt(sumTT);
  fit.linear[1] = -scale * sumT / std::sqrt(sumTT);
  fit.linear[2] = scale * std::sqrt(determinant / sumTT);
}

void fitAttitudes(const MassProperties& mass, const FlightSamples& samples, FlightFit& fit) {
  Turning start{samples.attitudes[0], estimatedAngularVelocities(samples.times, samples.attitudes)[0]};
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    const Eigen::MatrixXd slopes = jacobian(mass, start, samples);
    const Eigen::VectorXd change =
        (slopes.transpose() * slopes).ldlt().solve(-slopes.transpose() * residuals(mass, start, samples));
    start = start.changedBy(change);
    if (change.norm() < kConverged) {
      break;
    }
  }
  const Eigen::VectorXd left = residuals(mass, start, samples);
  fit.attitudeNoise = left.norm() / std::sqrt(static_cast<double>(left.size() - kSix));
  const Eigen::MatrixXd slopes = jacobian(mass, start, samples);
  const Eigen::MatrixXd normal = slopes.transpose() * slopes;
  const Eigen::MatrixXd covariance = normal.ldlt().solve(Eigen::MatrixXd::Identity(kSix, kSix));
  const Eigen::MatrixXd factor = fit.attitudeNoise * Eigen::MatrixXd(covariance.llt().matrixL());
  for (int row = 0; row < kSix; ++row) {
    for (int column = 0; column < kSix; ++column) {
      fit.angular.at(static_cast<std::size_t>(row * kSix + column)) = factor(row, column);
    }
  }
  fit.spin = start.spin;
  fit.start.pose.worldFromBody = start.attitude.toRotationMatrix();
  fit.start.angularMomentum = angularMomentum(mass, fit.start.pose.worldFromBody, start.spin);
}

}  // namespace

Vec3 rotationBetween(const Quat& from, const Quat& to) {
  Quat turn = to * from.conjugate();
  if (turn.w() < 0) {
    turn.coeffs() = -turn.coeffs();
  }
  const double sine = turn.vec().norm();
  return sine > 0 ? Vec3(2 * std::atan2(sine, turn.w()) / sine * turn.vec()) : Vec3::Zero();
}

FlightFit fitFlight(const MassProperties& mass, const Vec3& acceleration, const FlightSamples& samples) {
  if (samples.times.size() < kFewestFitted) {
    throw InputError("found " + std::to_string(samples.times.size()) +
                     " poses in free flight, expected at least " + std::to_string(kFewestFitted) + " to fit");
  }
  FlightFit fit;
  fitPositions(acceleration, samples, fit);
  fitAttitudes(mass, samples, fit);
  return fit;
}

BodyState startNear(const FlightFit& fit, const MassProperties& mass, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  BodyState state = fit.start;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double first = normal(random);
    state.pose.position[axis] += fit.linear[0] * first;
    state.velocity[axis] += fit.linear[1] * first + fit.linear[2] * normal(random);
  }
  Eigen::VectorXd change = Eigen::VectorXd::Zero(kSix);
  for (std::size_t column = 0; column < kSix; ++column) {
    const double each = normal(random);
    for (std::size_t row = 0; row < kSix; ++row) {
      change[static_cast<Eigen::Index>(row)] += fit.angular.at(row * kSix + column) * each;
    }
  }
  const Turning turned = Turning{Quat(fit.start.pose.worldFromBody), fit.spin}.changedBy(change);
  state.pose.worldFromBody = turned.attitude.toRotationMatrix();
  state.angularMomentum = angularMomentum(mass, state.pose.worldFromBody, turned.spin);
  return state;
}

}  // namespace careen
