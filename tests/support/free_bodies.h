#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "core/math/linear_algebra.h"
#include "support/taylor_oracle.h"

namespace careen::oracle {

/// Initial state of a free body: what TorqueFreeRotation takes.
struct Start {
  Vec3 moments;
  Quat attitude;
  Vec3 momentum;
};

/// Kinds of body and spin that use different branches of the closed form, or are hard for it.
enum class Draw {
  kGeneric,
  kExtremeShape,    // needles and plates, edges 1 : 10⁴
  kNearSymmetric,   // two moments equal to 1e-2 … 1e-15
  kSymmetric,       // two or three moments equal
  kNearAxis,        // spin about a body axis to 1e-2 … 1e-15
  kAxis,            // one or two components of the spin exactly zero
  kNearSeparatrix,  // to 1e-1 … 1e-14, attitude along the world's axes
  kCount,
};

class StartSource {
 public:
  explicit StartSource(unsigned seed) : generator_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_() >> 11U) * 0x1p-53;
  }
  double logUniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  int below(int n) { return static_cast<int>(generator_() % static_cast<unsigned>(n)); }

  Start draw(Draw kind) {
    const double ratio = kind == Draw::kExtremeShape ? 1e-4 : 0.1;
    const Vec3 edges(logUniform(ratio, 1), logUniform(ratio, 1), logUniform(ratio, 1));
    const Vec3 squares = edges.cwiseProduct(edges);
    Start start;
    start.moments = Vec3(squares[1] + squares[2], squares[0] + squares[2], squares[0] + squares[1]) / 12;
    start.attitude = Quat(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized();
    start.momentum = Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    const int i = below(3);
    const int j = (i + 1 + below(2)) % 3;
    switch (kind) {
      case Draw::kNearSymmetric:
        start.moments[j] = start.moments[i] * (1 + logUniform(1e-15, 1e-2));
        break;
      case Draw::kSymmetric:
        start.moments[j] = start.moments[i];
        if (below(4) == 0) {
          start.moments.setConstant(start.moments[i]);
        }
        break;
      case Draw::kNearAxis:
        start.attitude.setIdentity();
        start.momentum[i] *= logUniform(1e-15, 1e-2);
        start.momentum[j] *= logUniform(1e-15, 1);
        break;
      case Draw::kAxis:
        start.attitude.setIdentity();
        start.momentum[i] = 0;
        if (below(2) == 0) {
          start.momentum[j] = 0;
        }
        break;
      case Draw::kNearSeparatrix: {
        start.attitude.setIdentity();
        std::array<int, 3> order = {0, 1, 2};
        std::sort(order.begin(), order.end(),
                  [&](int a, int b) { return start.moments[a] < start.moments[b]; });
        const double i1 = start.moments[order[0]];
        const double i2 = start.moments[order[1]];
        const double i3 = start.moments[order[2]];
        start.momentum[order[0]] = start.momentum[order[2]] *
                                   std::sqrt((1 / i2 - 1 / i3) / (1 / i1 - 1 / i2)) *
                                   (1 + (below(2) == 0 ? 1 : -1) * logUniform(1e-14, 0.1));
        break;
      }
      default:
        break;
    }
    return start;
  }

 private:
  std::mt19937_64 generator_;
};

/// The oracle's body in the same state; the quaternion is normalised, so its rounding does not matter.
template <class Real>
FreeBody<Real> freeBody(const Start& start) {
  using std::sqrt;
  const Quat& q = start.attitude;
  Real squaredLength = 0;
  for (const double component : {q.w(), q.x(), q.y(), q.z()}) {
    squaredLength += Real(component) * Real(component);
  }
  const Real length = sqrt(squaredLength);
  const Real w = Real(q.w()) / length;
  const Real x = Real(q.x()) / length;
  const Real y = Real(q.y()) / length;
  const Real z = Real(q.z()) / length;
  const std::array<Real, 3> l = {Real(start.momentum[0]), Real(start.momentum[1]), Real(start.momentum[2])};
  const std::array<Real, 3> m = {
      (1 - 2 * (y * y + z * z)) * l[0] + 2 * (x * y + w * z) * l[1] + 2 * (x * z - w * y) * l[2],
      2 * (x * y - w * z) * l[0] + (1 - 2 * (x * x + z * z)) * l[1] + 2 * (y * z + w * x) * l[2],
      2 * (x * z + w * y) * l[0] + 2 * (y * z - w * x) * l[1] + (1 - 2 * (x * x + y * y)) * l[2]};
  return {{Real(start.moments[0]), Real(start.moments[1]), Real(start.moments[2])}, m, {w, x, y, z}};
}

/// The angle [rad] between two attitudes that nearly agree.
template <class Real, class Got>
double angleBetween(const FreeBody<Real>& body, const Quaternion<Got>& got) {
  using std::sqrt;
  const std::array<Real, 4> components = {Real(got.w()), Real(got.x()), Real(got.y()), Real(got.z())};
  Real same = 0;
  Real opposite = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    same += (components[i] - body.attitude[i]) * (components[i] - body.attitude[i]);
    opposite += (components[i] + body.attitude[i]) * (components[i] + body.attitude[i]);
  }
  return static_cast<double>(2 * sqrt(same < opposite ? same : opposite));
}

/// How far [rad] the attitude after t can move if every input moves by half a unit in its last place: no
/// method that takes doubles can be more accurate.
template <class Real>
double angleFromRoundingOfInput(const Start& start, const Real& t) {
  FreeBody<Real> exact = freeBody<Real>(start);
  advance(exact, t);
  double sum = 0;
  const auto add = [&](double& number, Start& changed) {
    number = std::nextafter(number, 2 * number);
    FreeBody<Real> body = freeBody<Real>(changed);
    advance(body, t);
    const Quaternion<Real> end(body.attitude[0], body.attitude[1], body.attitude[2], body.attitude[3]);
    sum += 0.5 * angleBetween(exact, end);
  };
  for (int i = 0; i < 3; ++i) {
    Start changed = start;
    add(changed.moments[i], changed);
    changed = start;
    add(changed.momentum[i], changed);
  }
  for (int i = 0; i < 4; ++i) {
    Start changed = start;
    add(changed.attitude.coeffs()[i], changed);
  }
  return sum;
}

inline double angularSpeedAtStart(const Start& start) {
  const Vec3 m = start.attitude.conjugate() * start.momentum;
  return m.cwiseQuotient(start.moments).norm();
}

}  // namespace careen::oracle
