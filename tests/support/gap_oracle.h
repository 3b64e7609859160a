#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "support/tumbling_box.h"

namespace careen::test {

struct Plane {
  Vec3 normal;
  double offset = 0;
};

// The oracles use corners only, no half extents along axes and no bounds.

template <class Real>
Real heightOverWall(const TumblingBox& box, const Plane& wall, const Real& t) {
  Real lowest = 1e30;
  for (const Vector3<Real>& corner : box.corners<Real>(t)) {
    const Real height = wall.normal.cast<Real>().dot(corner) - Real(wall.offset);
    lowest = height < lowest ? height : lowest;
  }
  return lowest;
}

template <class Real>
struct Shadow {
  Real low = 1e30;
  Real high = -1e30;
  Shadow(const std::array<Vector3<Real>, 8>& corners, const Vector3<Real>& direction) {
    for (const Vector3<Real>& corner : corners) {
      const Real at = direction.dot(corner);
      low = at < low ? at : low;
      high = at > high ? at : high;
    }
  }
};

// A box given by its corners and edge directions.
template <class Real>
struct Skeleton {
  std::array<Vector3<Real>, 8> corners;
  Matrix3<Real> edges;
};

// The largest separation of the corners' projections on the 15 axes; `towardsA` receives its axis.
template <class Real>
Real separation(const Skeleton<Real>& a, const Skeleton<Real>& b, Vec3* towardsA = nullptr) {
  using std::sqrt;
  // Below this length the cross product is only rounding error; a precise type resolves what double cannot.
  const Real parallel = std::numeric_limits<Real>::epsilon() * 100;
  std::vector<Vector3<Real>> directions;
  for (int i = 0; i < 3; ++i) {
    directions.push_back(a.edges.col(i));
    directions.push_back(b.edges.col(i));
    for (int j = 0; j < 3; ++j) {
      const Vector3<Real> edge = a.edges.col(i);
      const Vector3<Real> other = b.edges.col(j);
      const Vector3<Real> cross = edge.cross(other);
      if (cross.squaredNorm() > parallel * parallel) {
        directions.push_back(cross / sqrt(cross.squaredNorm()));
      }
    }
  }
  Real widest = -1e30;
  for (const Vector3<Real>& u : directions) {
    const Shadow<Real> ofA(a.corners, u);
    const Shadow<Real> ofB(b.corners, u);
    const bool above = ofA.low - ofB.high > ofB.low - ofA.high;
    const Real gap = above ? Real(ofA.low - ofB.high) : Real(ofB.low - ofA.high);
    if (gap > widest) {
      widest = gap;
      if (towardsA != nullptr) {
        *towardsA = (above ? 1 : -1) * u.template cast<double>();
      }
    }
  }
  return widest;
}

template <class Real>
Real separation(const TumblingBox& a, const TumblingBox& b, const Real& t, Vec3* towardsA = nullptr) {
  return separation<Real>({a.corners<Real>(t), a.orientation<Real>(t)},
                          {b.corners<Real>(t), b.orientation<Real>(t)}, towardsA);
}

// Boxes, thin plates, needles 1e4:1 and bullets, in turn.
inline TumblingBox roomFlight(Dice& dice, int k) {
  const std::array<Vec3, 4> shapes = {Vec3(0.5, 0.3, 0.2), Vec3(0.6, 0.4, 1e-3), Vec3(1, 1e-4, 1e-4),
                                      Vec3(0.1, 0.1, 0.1)};
  const auto shape = static_cast<std::size_t>(k % 4);
  const double turning = shape == 2 ? 40 : 8;
  TumblingBox box = tumblingBox(dice, shapes.at(shape), shape == 3 ? 1000 : 5, turning);
  box.position = dice.vector(1.5);
  box.gravity = {0, 0, k % 3 == 0 ? 0 : -9.81};
  return box;
}

struct Meeting {
  TumblingBox a;
  TumblingBox b;
};

// Two boxes aimed at each other: alike, needles, plates, one held still, one a bullet.
inline Meeting meeting(Dice& dice, int k) {
  const std::array<Vec3, 5> shapes = {Vec3(0.5, 0.3, 0.2), Vec3(1, 1e-4, 1e-4), Vec3(0.6, 0.4, 1e-3),
                                      Vec3(0.1, 0.1, 0.1), Vec3(1.5, 0.1, 0.7)};
  Meeting pair{.a = tumblingBox(dice, shapes.at(static_cast<std::size_t>(k % 5)), 2, 8),
               .b = tumblingBox(dice, shapes.at(static_cast<std::size_t>(k / 5 % 5)), 2, 8)};
  const bool fast = k % 7 == 0;
  pair.a.gravity = Vec3(0, 0, -9.81);
  pair.b.gravity = pair.a.gravity;
  if (k % 3 == 0) {
    pair.b.gravity.setZero();
    pair.b.velocity.setZero();
    pair.b.precession = 0;
    pair.b.spin = 0;
  }
  pair.b.position = 4 * dice.direction();
  const double meetAt = fast ? 0.005 : dice.between(0.5, 1);
  const Vec3 miss = dice.vector(0.3);
  // a's centre passes b's at about `meetAt`, whatever the gravity of each.
  pair.a.velocity = (pair.b.position + miss - pair.a.position) / meetAt + pair.b.velocity +
                    0.5 * meetAt * (pair.b.gravity - pair.a.gravity);
  return pair;
}

}  // namespace careen::test
