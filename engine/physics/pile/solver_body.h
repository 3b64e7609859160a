#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/math/lanes.h"
#include "core/math/linear_algebra.h"
#include "physics/pile/body.h"
#include "physics/pile/index.h"

namespace careen {

/// What impulses do to a body in PileSolver; as it is made, one that cannot move.
struct SolverBody {
  double inverseMass = 0;                                 ///< [1/kg]
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;  ///< [1/(kg m²)] world I⁻¹
  double radius = 0;                                      ///< [m]
  double change = 0;          ///< [m/s] change that puts its blocks back on the worklist
  Vec3 place = Vec3::Zero();  ///< [m] of its centre
  bool isBelt = false;        ///< cannot move, but its surface does

  bool moves() const { return inverseMass > 0; }
  /// I⁻¹ v
  Vec3 turned(const Vec3& v) const {
    return {xx * v.x() + xy * v.y() + xz * v.z(), xy * v.x() + yy * v.y() + yz * v.z(),
            xz * v.x() + yz * v.y() + zz * v.z()};
  }
};
SolverBody solverBody(const PileBody& body, double change);

/// How it moves: velocities, or displacements in their place. Read and written as two rows of four.
struct alignas(64) Moving {
  Vec3 velocity = Vec3::Zero();
  double unqueuedChange = 0;  ///< [m/s] change since its blocks were last put on the worklist
  Vec3 omega = Vec3::Zero();
  double pushed = 0;  ///< 1 if it was

  const void* row(std::size_t k) const { return reinterpret_cast<const char*>(this) + k * sizeof(Lanes); }
  void* row(std::size_t k) { return reinterpret_cast<char*>(this) + k * sizeof(Lanes); }
};
static_assert(sizeof(Moving) == 2 * sizeof(Lanes));

/// Four bodies, by index.
using LaneBodies = std::array<int, kLanes>;
struct MovingLanes {
  LanesVec v, w;
  Lanes unqueuedChange, pushed;
};

CAREEN_LANES MovingLanes movingOf(std::span<const Moving> all, const LaneBodies& bodies) {
  const auto row = [&](std::size_t lane, std::size_t k) __attribute__((always_inline)) {
    return lanesFrom(all[at(bodies[lane])].row(k));
  };
  MovingLanes lanes{.v = {row(0, 0), row(1, 0), row(2, 0)},
                    .w = {row(0, 1), row(1, 1), row(2, 1)},
                    .unqueuedChange = row(3, 0),
                    .pushed = row(3, 1)};
  transpose(lanes.v.x, lanes.v.y, lanes.v.z, lanes.unqueuedChange);
  transpose(lanes.w.x, lanes.w.y, lanes.w.z, lanes.pushed);
  return lanes;
}

CAREEN_LANES void setMoving(std::span<Moving> all, const LaneBodies& bodies, MovingLanes lanes) {
  transpose(lanes.v.x, lanes.v.y, lanes.v.z, lanes.unqueuedChange);
  transpose(lanes.w.x, lanes.w.y, lanes.w.z, lanes.pushed);
  const auto setOne = [&](std::size_t lane, const Lanes& velocity, const Lanes& omega)
      __attribute__((always_inline)) {
    Moving& body = all[at(bodies[lane])];
    lanesTo(velocity, body.row(0));
    lanesTo(omega, body.row(1));
  };
  setOne(0, lanes.v.x, lanes.w.x);
  setOne(1, lanes.v.y, lanes.w.y);
  setOne(2, lanes.v.z, lanes.w.z);
  setOne(3, lanes.unqueuedChange, lanes.pushed);
}

}  // namespace careen
