#include "question/motion_bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "physics/world/method.h"

namespace careen {
namespace {

class RandomMotions {
 public:
  Vec3 vector(double size) { return Vec3(number(size), number(size), number(size)); }
  double number(double size) { return std::uniform_real_distribution<double>(-size, size)(random_); }
  Quat rotation() { return Quat(Vec4(number(1), number(1), number(1), number(1))).normalized(); }
  BodyState state(const MassProperties& mass) {
    BodyState state{.pose = {.position = vector(2), .worldFromBody = rotation().toRotationMatrix()},
                    .velocity = vector(3),
                    .angularMomentum = Vec3::Zero()};
    state.angularMomentum = angularMomentum(mass, state.pose.worldFromBody, vector(4));
    return state;
  }
  Flight flight(const MassProperties& mass) {
    const BodyState start = state(mass);
    return {.position = start.pose.position,
            .velocity = start.velocity,
            .acceleration = vector(9),
            .worldFromBody = Quat(start.pose.worldFromBody),
            .angularMomentum = start.angularMomentum};
  }
  template <class Step>
  Step polynomial(double duration) {
    Step step;
    step.duration = duration;
    double size = 1;
    const Quat start = rotation();
    for (std::size_t k = 0; k < step.position.size(); ++k) {
      step.position[k] = vector(size);
      step.worldFromBody[k] =
          k == 0 ? start.coeffs() : Vec4(0.05 * size * Vec4(number(1), number(1), number(1), number(1)));
      // Across the quaternion, which so keeps its length but for squares.
      step.worldFromBody[k] -=
          k == 0 ? Vec4(Vec4::Zero()) : Vec4(step.worldFromBody[k].dot(start.coeffs()) * start.coeffs());
      size *= 0.3;
    }
    return step;
  }

 private:
  std::mt19937 random_{7};
};

// Differences of states at many times, which never exceed a bound and, of the closest ones, come near it.
struct Largest {
  double place = 0;
  double placeBend = 0;
  double speed = 0;
  double velocity = 0;
  double velocityBend = 0;
  double spin = 0;
  double spinRate = 0;
  double spinBend = 0;
  double along = 0;
  double alongBend = 0;
};

Largest largestOf(const Motion& motion, const MassProperties& mass, double duration, const Vec3& direction) {
  constexpr int kTimes = 400;
  const double h = 1e-4 * duration;
  Largest largest;
  const auto note = [](double& most, double value) { most = std::max(most, value); };
  for (int i = 0; i <= kTimes; ++i) {
    const double t = h + (duration - 2 * h) * i / kTimes;
    const BodyState before = stateAt(motion, mass, t - h);
    const BodyState now = stateAt(motion, mass, t);
    const BodyState after = stateAt(motion, mass, t + h);
    const auto rate = [&](const Vec3& a, const Vec3& b) { return Vec3((b - a) / (2 * h)); };
    const auto bend = [&](const Vec3& a, const Vec3& m, const Vec3& b) {
      return Vec3((a - 2 * m + b) / (h * h));
    };
    const Vec3 w0 = angularVelocity(mass, before);
    const Vec3 w = angularVelocity(mass, now);
    const Vec3 w1 = angularVelocity(mass, after);
    const Vec3 moved = rate(before.pose.position, after.pose.position);
    const Vec3 bent = bend(before.pose.position, now.pose.position, after.pose.position);
    note(largest.place, moved.norm());
    note(largest.placeBend, bent.norm());
    note(largest.along, std::fabs(moved.dot(direction)));
    note(largest.alongBend, std::fabs(bent.dot(direction)));
    note(largest.speed, now.velocity.norm());
    note(largest.velocity, rate(before.velocity, after.velocity).norm());
    note(largest.velocityBend, bend(before.velocity, now.velocity, after.velocity).norm());
    note(largest.spin, w.norm());
    note(largest.spinRate, rate(w0, w1).norm());
    note(largest.spinBend, bend(w0, w, w1).norm());
    const Quat turn(Mat3(after.pose.worldFromBody * before.pose.worldFromBody.transpose()));
    note(largest.spin, 2 * std::asin(std::min(1.0, turn.vec().norm())) / (2 * h));
  }
  return largest;
}

void expectWithin(const Motion& motion, const MassProperties& mass, double duration, const Vec3& direction,
                  const char* what) {
  const MotionBounds bounds = boundsOf(motion, mass, 0, duration);
  const RateBounds along = boundsAlong(motion, direction, 0, duration);
  const Largest largest = largestOf(motion, mass, duration, direction);
  const double h = 1e-4 * duration;
  const double rounding = 1e-14 / h;  // of first differences; of second ones per h more
  const auto within = [&](double found, double bound, double error, const char* which) {
    EXPECT_LE(found, bound * (1 + 1e-6) + error) << what << ' ' << which;
  };
  within(largest.place, bounds.place.rate, rounding, "place");
  within(largest.placeBend, bounds.place.bend, rounding / h, "placeBend");
  within(largest.speed, bounds.speed, 1e-14, "speed");
  within(largest.velocity, bounds.velocity.rate, rounding, "velocity");
  within(largest.velocityBend, bounds.velocity.bend, 30 * rounding / h, "velocityBend");
  within(largest.spin, bounds.spin, 30 * rounding, "spin");
  within(largest.spinRate, bounds.angularVelocity.rate, 30 * rounding, "spinRate");
  within(largest.spinBend, bounds.angularVelocity.bend, 100 * rounding / h, "spinBend");
  within(largest.along, along.rate, rounding, "along");
  within(largest.alongBend, along.bend, rounding / h, "alongBend");
}

TEST(MotionBounds, hold) {
  RandomMotions random;
  for (int i = 0; i < 40; ++i) {
    const MassProperties mass = solidBox(Vec3(0.1, 0.2, 0.35) + 0.05 * random.vector(1).cwiseAbs(), 2);
    const Vec3 direction = random.vector(1).normalized();
    const Flight flight = random.flight(mass);
    expectWithin(flight, mass, 0.7, direction, "flight");
    Flight sloping = flight;
    sloping.jerk = random.vector(20);
    expectWithin(sloping, mass, 0.7, direction, "flight with jerk");
    expectWithin(random.polynomial<ContactStep>(0.3), mass, 0.3, direction, "contact step");
    expectWithin(random.polynomial<CrowdStep>(0.1), mass, 0.1, direction, "crowd step");
    expectWithin(Rest{.pose = random.state(mass).pose}, mass, 1, direction, "rest");
    expectWithin(
        EulerStep{.start = random.state(mass), .force = random.vector(4), .torque = random.vector(0.1)}, mass,
        0.01, direction, "Euler step");
    SampledStep sampled{.duration = 0.02, .start = random.state(mass), .end = {}};
    sampled.end = stateAt(Flight{.position = sampled.start.pose.position,
                                 .velocity = sampled.start.velocity,
                                 .worldFromBody = Quat(sampled.start.pose.worldFromBody),
                                 .angularMomentum = sampled.start.angularMomentum},
                          mass, 0.02);
    expectWithin(sampled, mass, 0.02, direction, "sampled step");
  }
}

// Where they follow from conserved quantities they are attained: of a cube, whose ω is constant, and of
// speed.
TEST(MotionBounds, ofFlightAreClose) {
  RandomMotions random;
  const MassProperties cube = solidBox(Vec3::Constant(0.5), 1);
  Flight flight = random.flight(cube);
  const MotionBounds bounds = boundsOf(flight, cube, 0, 2);
  const double spin = flight.angularMomentum.norm() / cube.inertiaBody.x();
  EXPECT_NEAR(bounds.spin, spin, 1e-8 * spin);
  EXPECT_LT(bounds.angularVelocity.rate, 1e-12);
  EXPECT_NEAR(bounds.place.bend, flight.acceleration.norm(), 1e-8);
  // A needle that turns about an axis across it, whose moment is the largest.
  const MassProperties needle = solidBox(Vec3(1, 0.01, 0.005), 1);
  flight.worldFromBody = Quat::Identity();
  flight.angularMomentum = angularMomentum(needle, Mat3::Identity(), Vec3(0, 0, 3));
  EXPECT_NEAR(boundsOf(flight, needle, 0, 2).spin, 3, 1e-6);
  flight.velocity = Vec3(0, 0, -1);
  flight.acceleration = Vec3(0, 0, -10);
  EXPECT_NEAR(boundsOf(flight, cube, 1, 2).speed, 21, 1e-7);
  EXPECT_NEAR(boundsAlong(flight, Vec3::UnitZ(), 1, 2).rate, 21, 1e-7);
  EXPECT_EQ(boundsAlong(flight, Vec3::UnitX(), 1, 2).rate, 0);
}

}  // namespace
}  // namespace careen
