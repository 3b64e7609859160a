#include "physics/motion/hermite_step.h"

#include <type_traits>

namespace careen {
namespace {

// A quantity with its first and second derivative.
template <class Vector>
struct Interpolant {
  Vector value;
  Vector rate;
  Vector acceleration;
};

template <class Vector>
void fill(const Interpolant<Vector>& from, const Interpolant<Vector>& to, double h, std::array<Vector, 6>& c) {
  const Vector d = to.value - from.value;
  c[0] = from.value;
  c[1] = h * from.rate;
  c[2] = (0.5 * h * h) * from.acceleration;
  c[3] = 10 * d - h * (6 * from.rate + 4 * to.rate) -
         (h * h) * (1.5 * from.acceleration - 0.5 * to.acceleration);
  c[4] = -15 * d + h * (8 * from.rate + 7 * to.rate) + (h * h) * (1.5 * from.acceleration - to.acceleration);
  c[5] =
      6 * d - h * (3 * from.rate + 3 * to.rate) - (h * h) * (0.5 * from.acceleration - 0.5 * to.acceleration);
}

template <class Vector>
void fillCubic(const Vector& from, const Vector& rateFrom, const Vector& to, const Vector& rateTo, double h,
               std::array<Vector, 4>& c) {
  const Vector d = to - from;
  c[0] = from;
  c[1] = h * rateFrom;
  c[2] = 3 * d - h * (2 * rateFrom + rateTo);
  c[3] = h * (rateFrom + rateTo) - 2 * d;
}

Quat pure(const Vec3& v) { return {0, v[0], v[1], v[2]}; }

// q̇ = ½ q ω, with ω in the body's frame.
Vec4 turningRate(const StepEnd& end) { return 0.5 * (end.worldFromBody * pure(end.spinBody)).coeffs(); }

// q̈ = ½ (q̇ ω + q ω̇).
Interpolant<Vec4> turning(const StepEnd& end) {
  const Vec4 rate = turningRate(end);
  const Vec4 bent =
      (Quat(rate) * pure(end.spinBody)).coeffs() + (end.worldFromBody * pure(end.spinRateBody)).coeffs();
  return {end.worldFromBody.coeffs(), rate, 0.5 * bent};
}

}  // namespace

ContactStep hermiteStep(const StepEnd& from, const StepEnd& to, double length) {
  ContactStep step{.duration = length > 0 ? length : 1};
  fill<Vec3>({from.position, from.velocity, from.acceleration}, {to.position, to.velocity, to.acceleration},
             length, step.position);
  fill<Vec4>(turning(from), turning(to), length, step.worldFromBody);
  return step;
}

CrowdStep cubicStep(const StepEnd& from, const StepEnd& to, double length) {
  CrowdStep step{.duration = length > 0 ? length : 1};
  fillCubic(from.position, from.velocity, to.position, to.velocity, length, step.position);
  const Vec4& turned = from.worldFromBody.coeffs();
  const double sign = dot(to.worldFromBody.coeffs(), turned) < 0 ? -1 : 1;
  fillCubic<Vec4>(turned, turningRate(from), sign * to.worldFromBody.coeffs(), sign * turningRate(to), length,
                  step.worldFromBody);
  return step;
}

StepEnd endWithin(const CrowdStep& step, double elapsed) {
  const double s = elapsed / step.duration;
  const auto value = [&](const auto& c) { return (c[0] + s * (c[1] + s * (c[2] + s * c[3]))).eval(); };
  const auto slope = [&](const auto& c) {
    return ((c[1] + s * (2 * c[2] + s * (3 * c[3]))) / step.duration).eval();
  };
  const Vec4 turn = value(step.worldFromBody);
  const Quat rate(Vec4(slope(step.worldFromBody)));
  return {.position = value(step.position),
          .velocity = slope(step.position),
          .worldFromBody = Quat(turn).normalized(),
          .spinBody = (2 / turn.squaredNorm()) * (Quat(turn).conjugate() * rate).vec()};
}

}  // namespace careen
