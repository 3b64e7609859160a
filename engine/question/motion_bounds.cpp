#include "question/motion_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace careen {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();
constexpr double kOfRounding = 1 + 0x1p-30;

// Σ |c[k]| times the derivative of sᵏ at s = 1, `order` times, per second.
template <class Sizes>
double polynomialBound(const Sizes& sizes, double duration, std::size_t order) {
  double sum = 0;
  for (std::size_t k = order; k < sizes.size(); ++k) {
    double factor = 1;
    for (std::size_t i = 0; i < order; ++i) {
      factor *= static_cast<double>(k - i);
    }
    sum += factor * sizes[k];
  }
  return kOfRounding * sum / std::pow(duration, static_cast<double>(order));
}

template <class Coefficients>
std::array<double, 6> sizesOf(const Coefficients& coefficients) {
  std::array<double, 6> sizes{};
  std::transform(coefficients.begin(), coefficients.end(), sizes.begin(),
                 [](const auto& vector) { return vector.norm(); });
  return sizes;
}

struct Moments {
  double least = 0;   // [kg m²] principal
  double uneven = 0;  // [1] |dω/dt| of a free body is at most so many times ω²
};

Moments momentsOf(const MassProperties& mass) {
  const Vec3& j = mass.inertiaBody;
  Moments moments{.least = j.minCoeff()};
  for (int i = 0; i < 3; ++i) {
    moments.uneven = std::max(moments.uneven, std::fabs(j[(i + 1) % 3] - j[(i + 2) % 3]) / j[i]);
  }
  return moments;
}

// Euler's equations, Jω' = Jω × ω in the body: each component of ω' is at most `uneven` times a product of
// two of ω, and its rate twice as much with one of ω' in place of one of ω; in the world ω × ω' adds to that.
void addFreeTurning(const MassProperties& mass, double spin, MotionBounds& bounds) {
  const Moments moments = momentsOf(mass);
  bounds.spin = kOfRounding * spin;
  bounds.angularVelocity.rate = kOfRounding * moments.uneven * spin * spin;
  bounds.angularVelocity.bend = kOfRounding * (2 * moments.uneven + 1) * spin * bounds.angularVelocity.rate;
}

// A velocity with jerk leaves its chord by at most that times t²/8.
double leavesChord(double from, double to, double jerk) { return 0.125 * (to - from) * (to - from) * jerk; }

MotionBounds flightBounds(const Flight& flight, const MassProperties& mass, double from, double to) {
  MotionBounds bounds;
  const double jerk = flight.jerk.norm();
  const double acceleration = jerk == 0 ? flight.acceleration.norm()
                                        : kOfRounding * std::max(flight.accelerationAt(from).norm(),
                                                                 flight.accelerationAt(to).norm());
  bounds.speed = kOfRounding * (std::max(flight.velocityAt(from).norm(), flight.velocityAt(to).norm()) +
                                leavesChord(from, to, jerk));
  bounds.place = {.rate = bounds.speed, .bend = acceleration};
  bounds.velocity = {.rate = acceleration, .bend = jerk};
  // Of m = Jω both Σ mᵢ² = L² and Σ uᵢ mᵢ² = ω·L are constant, where uᵢ = 1/Jᵢ; and ω² = Σ uᵢ² mᵢ², where u²
  // is not above its chord from the least to the largest u.
  const BodyState start{.pose = {.worldFromBody = flight.worldFromBody.normalized().toRotationMatrix()},
                        .angularMomentum = flight.angularMomentum};
  const double twice = angularVelocity(mass, start).dot(flight.angularMomentum);
  const double least = mass.inverseInertiaBody.minCoeff();
  const double most = mass.inverseInertiaBody.maxCoeff();
  const double squared = (least + most) * twice - least * most * flight.angularMomentum.squaredNorm();
  constexpr double kLost = 0x1p-40;  // [1] where the difference is small
  addFreeTurning(mass, std::sqrt(std::max(0.0, squared + kLost * (least + most) * twice)), bounds);
  return bounds;
}

struct BoundsIn {
  const MassProperties& mass;
  double from;
  double to;

  MotionBounds operator()(const Rest& /*rest*/) const { return {}; }
  MotionBounds operator()(const Flight& flight) const { return flightBounds(flight, mass, from, to); }
  MotionBounds operator()(const SteppedFlight& stepped) const {
    MotionBounds bounds = flightBounds(stepped.start, mass, from, to);
    addFreeTurning(mass, 2 * bounds.spin, bounds);  // whatever the steps do to energy
    bounds.angularVelocity.bend = kUnknown;
    return bounds;
  }
  MotionBounds operator()(const EulerStep& step) const {
    MotionBounds bounds;
    const double acceleration = mass.inverseMass * step.force.norm();
    bounds.place.rate = kOfRounding * step.start.velocity.norm();
    bounds.speed = bounds.place.rate + to * acceleration;
    bounds.velocity.rate = kOfRounding * acceleration;
    const double least = momentsOf(mass).least;
    const double turning = step.start.angularMomentum.norm() + to * step.torque.norm();
    bounds.spin = kOfRounding * turning / least;
    // I⁻¹ turns with the body: its rate is at most 2ω/J.
    bounds.angularVelocity.rate = step.torque.norm() / least + 2 * bounds.spin * bounds.spin;
    bounds.angularVelocity.bend = kUnknown;
    return bounds;
  }
  MotionBounds operator()(const CrowdStep& step) const { return (*this)(asContactStep(step)); }
  MotionBounds operator()(const ContactStep& step) const {
    const StepBounds whole = careen::boundsOf(step);
    const std::array<double, 6> sizes = sizesOf(step.position);
    return {.place = {.rate = whole.speed, .bend = whole.acceleration},
            .speed = whole.speed,
            .velocity = {.rate = whole.acceleration, .bend = polynomialBound(sizes, step.duration, 3)},
            .spin = whole.angularSpeed,
            .angularVelocity = {.rate = whole.angularAcceleration, .bend = kUnknown}};
  }
  // Cubics between both ends whose quaternion stays longer than ½: ω = 2 q̇ q*/|q|².
  MotionBounds operator()(const SampledStep& step) const {
    MotionBounds bounds;
    const double seconds = step.duration;
    const double way = (step.end.pose.position - step.start.pose.position).norm();
    const double speeds = step.start.velocity.norm() + step.end.velocity.norm();
    bounds.place = {.rate = 1.5 * way / seconds + speeds, .bend = (6 * way / seconds + 4 * speeds) / seconds};
    bounds.speed = bounds.place.rate;
    bounds.velocity = {.rate = bounds.place.bend,
                       .bend = (12 * way / seconds + 6 * speeds) / seconds / seconds};
    constexpr double kFarthest = 2;  // of two quaternions of length 1
    const double spins =
        0.5 * (angularVelocity(mass, step.start).norm() + angularVelocity(mass, step.end).norm());
    const double rate = 1.5 * kFarthest / seconds + spins;
    const double bend = (6 * kFarthest / seconds + 4 * spins) / seconds;
    bounds.spin = 4 * rate;
    bounds.angularVelocity = {.rate = 4 * bend + 24 * rate * rate, .bend = kUnknown};
    return bounds;
  }
  MotionBounds operator()(const Driven& driven) const {
    const MotionRates most = careen::boundsOf(driven);
    const double w = most.angularSpeed;
    const double wRate = most.angularAcceleration;
    const double jerk = driven.rate * driven.rate * driven.rate * driven.amplitude.norm() +
                        (w * w * w + 3 * w * wRate + driven.rate * wRate) * driven.arm.norm();
    return {.place = {.rate = kOfRounding * most.speed, .bend = most.acceleration},
            .speed = kOfRounding * most.speed,
            .velocity = {.rate = kOfRounding * most.acceleration, .bend = jerk},
            .spin = kOfRounding * w,
            .angularVelocity = {.rate = kOfRounding * wRate, .bend = driven.rate * wRate}};
  }
};

struct BoundsAlong {
  const Vec3& direction;
  double from;
  double to;

  RateBounds operator()(const Rest& /*rest*/) const { return {}; }
  RateBounds operator()(const Flight& flight) const {
    const double rate = std::max(std::fabs(direction.dot(flight.velocityAt(from))),
                                 std::fabs(direction.dot(flight.velocityAt(to)))) +
                        leavesChord(from, to, std::fabs(direction.dot(flight.jerk)));
    const double bend = std::max(std::fabs(direction.dot(flight.accelerationAt(from))),
                                 std::fabs(direction.dot(flight.accelerationAt(to))));
    return {.rate = kOfRounding * rate, .bend = kOfRounding * bend};
  }
  RateBounds operator()(const SteppedFlight& stepped) const { return (*this)(stepped.start); }
  RateBounds operator()(const EulerStep& step) const {
    return {.rate = kOfRounding * std::fabs(direction.dot(step.start.velocity))};
  }
  RateBounds operator()(const CrowdStep& step) const { return (*this)(asContactStep(step)); }
  RateBounds operator()(const ContactStep& step) const {
    std::array<double, 6> sizes{};
    std::transform(step.position.begin(), step.position.end(), sizes.begin(),
                   [this](const Vec3& coefficient) { return std::fabs(direction.dot(coefficient)); });
    return {.rate = polynomialBound(sizes, step.duration, 1),
            .bend = polynomialBound(sizes, step.duration, 2)};
  }
  RateBounds operator()(const SampledStep& step) const {
    const double way = std::fabs(direction.dot(step.end.pose.position - step.start.pose.position));
    const double speeds =
        std::fabs(direction.dot(step.start.velocity)) + std::fabs(direction.dot(step.end.velocity));
    return {.rate = 1.5 * way / step.duration + speeds,
            .bend = (6 * way / step.duration + 4 * speeds) / step.duration};
  }
  RateBounds operator()(const Driven& driven) const {
    const MotionRates most = careen::boundsOf(driven);
    return {.rate = kOfRounding * most.speed, .bend = kOfRounding * most.acceleration};
  }
};

}  // namespace

MotionBounds boundsOf(const Motion& motion, const MassProperties& mass, double from, double to) {
  return std::visit(BoundsIn{.mass = mass, .from = from, .to = to}, motion);
}

RateBounds boundsAlong(const Motion& motion, const Vec3& direction, double from, double to) {
  return std::visit(BoundsAlong{.direction = direction, .from = from, .to = to}, motion);
}

}  // namespace careen
