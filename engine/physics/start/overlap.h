#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/math/linear_algebra.h"
#include "core/math/pose.h"
#include "physics/world/world.h"

namespace careen {

/// How deep in a wall or a box a box may start, for rounding's sake: this much of the lengths its gap is the
/// difference of.
inline constexpr double kGapAllowance = 1e-12;

/// A box where it stands, to be asked whether it shares space with others.
struct PlacedBox {
  std::string name;
  Vec3 halfExtents = Vec3::Zero();  ///< [m]
  Pose pose = {};
  double inverseMass = 0;  ///< [1/kg] 0: held, it stays where it is
};

/// Two boxes that share space, and how deep [m].
struct Overlap {
  std::size_t first = 0;
  std::size_t second = 0;
  double depth = 0;
};
/// The first two in the order given, two held ones excepted, that overlap by more than kGapAllowance: least
/// `second`, then least `first`. Sorted along x, so that boxes in rows and heaps cost little more than
/// O(n log n).
std::optional<Overlap> firstOverlap(std::span<const PlacedBox> boxes);
/// All of them, in no stated order.
std::vector<Overlap> overlaps(std::span<const PlacedBox> boxes);

/// Gap of a box's lowest corner to a wall, n·x − Σ hᵢ|n·aᵢ| − offset [m], and the lengths it is the
/// difference of.
struct LowestGap {
  double gap = 0;
  double lengths = 0;
  bool overlaps() const { return gap < -kGapAllowance * lengths; }
};
LowestGap lowestGap(const Wall& wall, const Vec3& halfExtents, const Pose& pose);

/// What a box can meet.
enum class Meeting { kWalls, kAll };

/// How overlapping boxes were moved apart.
struct Parted {
  std::vector<Vec3> positions;  ///< [m] of every box, in the order given
  std::size_t pairs = 0;        ///< of boxes that overlapped, before or on the way
  std::size_t behindWalls = 0;  ///< boxes and walls that did
  std::size_t moved = 0;        ///< boxes
  double furthest = 0;          ///< [m] that one of them was moved
};

/// Moves boxes out of each other and out of walls, turning none and changing no velocity: no kinetic energy
/// is added. Each pair is parted along the axis of least depth, and of all ways to do that the one with the
/// least Σ mass · distance² is taken, where no box counts for more than 64 of the lightest. Held boxes stay.
/// Where an axis leaves no room, as down into the floor, the pair's next best is tried.
///
/// Along a fixed axis the gap of boxes that do not turn is linear in their positions, so the least movement
/// is a quadratic programme; C. Hildreth 1957 solves it by one multiplier at a time. Pairs are taken in the
/// order of the boxes' names, so the order given changes no bit.
///
/// Not used: the pile's projection. Without turning, 3000 of its passes leave 0.1 m under a top 1e4 times as
/// heavy, and where the axis of least depth has no room; and it cannot tell that there is no room at all.
///
/// InputError names a pair for which no room was found.
Parted moveApart(std::span<const PlacedBox> boxes, std::span<const Wall> walls,
                 Meeting meeting = Meeting::kAll);

}  // namespace careen
