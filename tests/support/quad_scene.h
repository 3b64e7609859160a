#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/math/linear_algebra.h"
#include "support/quad.h"
#include "support/taylor_oracle.h"

namespace careen::oracle {

using QuadVector = Vector3<Quad>;
template <class Real>
using Turn = std::array<Real, 4>;  // w x y z, unit
using QuadTurn = Turn<Quad>;

/// Product of quaternions.
template <class Real>
Turn<Real> times(const Turn<Real>& a, const Turn<Real>& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
          a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
          a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}
inline QuadTurn inverse(const QuadTurn& q) { return {q[0], -q[1], -q[2], -q[3]}; }
template <class Real>
Turn<Real> normalized(Turn<Real> q) {
  const Real length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (Real& part : q) {
    part /= length;
  }
  return q;
}
template <class To, class From, std::size_t kCount>
std::array<To, kCount> converted(const std::array<From, kCount>& numbers) {
  std::array<To, kCount> result;
  for (std::size_t i = 0; i < kCount; ++i) {
    result[i] = static_cast<To>(numbers[i]);
  }
  return result;
}
inline QuadVector turned(const QuadTurn& q, const QuadVector& v) {
  const QuadTurn r = times(times(q, QuadTurn{0, v[0], v[1], v[2]}), inverse(q));
  return {r[1], r[2], r[3]};
}

/// Pose of a box at a time.
struct QuadPose {
  QuadVector position;
  QuadTurn attitude;
};

/// Difference of two poses: the larger of the distance [m] and the angle [rad].
inline double apart(const QuadPose& a, const QuadPose& b) {
  const QuadTurn turn = times(inverse(a.attitude), b.attitude);
  const Quad angle = 2 * sqrt(turn[1] * turn[1] + turn[2] * turn[2] + turn[3] * turn[3]);
  const Quad distance = (a.position - b.position).norm();
  return static_cast<double>(angle > distance ? angle : distance);
}

/// The largest of such differences, pose by pose; infinite if there are not as many.
inline double furthestApart(std::span<const QuadPose> some, std::span<const QuadPose> others) {
  double worst = some.size() == others.size() ? 0 : std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < std::min(some.size(), others.size()); ++k) {
    worst = std::max(worst, apart(some[k], others[k]));
  }
  return worst;
}

/// The free side is where normal·x > offset.
struct QuadWall {
  QuadVector normal;
  Quad offset = 0;
  Quad restitution = 0;
  Quad friction = 0;
  QuadVector belt = QuadVector::Zero();  // [m/s] of its surface
  Quad spin = 0;                         // [rad/s] of its surface about the normal through the origin
};

struct QuadBox {
  std::string name;
  QuadVector halfExtents;
  Quad mass = 0;
  std::array<Quad, 3> moments;  // [kg m²]
  Quad restitution = 0;
  Quad friction = 0;
  bool fixed = false;
  QuadVector position;
  QuadVector velocity;
  QuadTurn attitude = {1, 0, 0, 0};
  std::array<Quad, 3> momentum;  // [kg m²/s] angular, body frame
  // Of a fixed one that moves, besides its velocity: where it is at each time [s], and how it swings.
  std::vector<std::pair<Quad, QuadVector>> path = {};
  QuadVector amplitude = QuadVector::Zero();  // [m]
  Quad rate = 0;                              // [rad/s]
  Quad phase = 0;

  FreeBody<Quad> freeBody() const { return {moments, momentum, attitude}; }
};

/// What the oracles need of a joint.
struct QuadJoint {
  QuadVector at;  ///< [m] where it is at the start, or where the end of a rope is in the world
  Quad length = 0;
  Quad restitution = 0;
  Quad start = 0;
  Quad stiffness = 0;
  Quad damping = 0;
};

/// A scene in quadruple precision, read independently of the engine: input of the oracles.
struct QuadScene {
  double duration = 0;
  QuadVector gravity;
  std::vector<std::pair<Quad, QuadVector>> gravities;  // from each time [s] on; if it changes
  std::vector<QuadWall> walls;
  std::vector<QuadBox> boxes;
  std::vector<QuadJoint> joints;
  // Of the one motor: k and d of each joint that it looks at, or what it aims at.
  Quad period = 0;
  std::vector<Quad> gains;
  Quad target = 0;
  Quad kp = 0;
  Quad kd = 0;
};

}  // namespace careen::oracle
