#pragma once

#include <array>
#include <cstddef>
#include <random>
#include <span>

#include "physics/world/body.h"

namespace careen {

/// Measured poses of one body in free flight.
struct FlightSamples {
  std::span<const double> times;    ///< [s] ascending, the first is 0
  std::span<const Vec3> positions;  ///< [m]
  std::span<const Quat> attitudes;  ///< world from body, of length 1, either sign
};

/// The free flight closest to measured poses, and how well they determine it.
struct FlightFit {
  BodyState start;           ///< at 0 s
  Vec3 spin = Vec3::Zero();  ///< [rad/s] of the start, world
  double positionNoise = 0;  ///< [m] root mean square of what is left, for each coordinate
  double attitudeNoise = 0;  ///< [rad] likewise, about each axis
  /// Standard deviations and correlation of position and velocity, equal for all coordinates, and of attitude
  /// [rad] and angular velocity [rad/s], about the world's axes: Cholesky factors L of the covariances L Lᵀ.
  std::array<double, 3> linear{};    ///< l₀₀ [m], l₁₀ [m/s], l₁₁ [m/s]
  std::array<double, 36> angular{};  ///< 6 × 6 by rows, attitude first
};

/// The least rows that a fit takes.
inline constexpr std::size_t kFewestFitted = 4;

/// Least squares: positions by a parabola of this acceleration [m/s²], for which it is linear; attitudes by
/// the torque-free rotation of this body (Gauss–Newton on rotation vectors, from finite differences). At
/// least kFewestFitted samples, else InputError.
FlightFit fitFlight(const MassProperties& mass, const Vec3& acceleration, const FlightSamples& samples);

/// A start as far from the fitted one as the noise of the samples allows: one of many equally likely ones.
BodyState startNear(const FlightFit& fit, const MassProperties& mass, std::mt19937_64& random);

/// The rotation vector [rad], world frame, from one attitude to another: the shorter way round.
Vec3 rotationBetween(const Quat& from, const Quat& to);

}  // namespace careen
