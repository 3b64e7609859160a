#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/math/linear_algebra.h"
#include "core/math/pose.h"
#include "physics/geometry/box_at.h"
#include "physics/world/world.h"

namespace careen {

/// Allowed initial penetration due to rounding, relative to the lengths whose difference is the gap.
inline constexpr double kGapAllowance = 1e-12;

/// A box with its pose, that of its middle, for overlap tests; or several boxes in one frame, and that around
/// them about its origin.
struct PlacedBox {
  std::string name;
  Vec3 halfExtents = Vec3::Zero();  ///< [m]
  Pose pose = {};
  double inverseMass = 0;            ///< [1/kg] 0: fixed
  std::vector<BodyPart> parts = {};  ///< none: the box itself

  int partCount() const { return parts.empty() ? 1 : static_cast<int>(parts.size()); }
  BoxAt at(int part) const;
};
/// A body at a pose.
PlacedBox placedBox(const Body& body, const Pose& pose);

/// Two overlapping boxes, and the penetration depth [m]; of several boxes, of those that are deepest.
struct Overlap {
  std::size_t first = 0;
  std::size_t second = 0;
  double depth = 0;
};
/// Pairs of boxes that pass through each other, by index, the lesser first; sorted.
using ApartPairs = std::span<const std::pair<int, int>>;

/// The first pair in the given order, not both fixed, that overlaps by more than kGapAllowance: least
/// `second`, then least `first`. Sweep along x: boxes in rows and heaps cost little more than O(n log n).
std::optional<Overlap> firstOverlap(std::span<const PlacedBox> boxes, ApartPairs apart = {});
/// All overlapping pairs, in unspecified order.
std::vector<Overlap> overlaps(std::span<const PlacedBox> boxes, ApartPairs apart = {});

/// Gap of a box to a wall [m], see gapToPlane, and the lengths whose difference it is.
struct LowestGap {
  double gap = 0;
  double lengths = 0;
  bool overlaps() const { return gap < -kGapAllowance * lengths; }
};
LowestGap lowestGap(const Wall& wall, const PlacedBox& box);

/// What boxes can collide with.
enum class Meeting { kWalls, kAll };

/// Result of moving overlapping boxes apart.
struct Parted {
  std::vector<Vec3> positions;  ///< [m] of every box, in the order given
  std::size_t pairs = 0;        ///< pairs of boxes that overlapped, before or during
  std::size_t behindWalls = 0;  ///< box–wall pairs that overlapped
  std::size_t moved = 0;        ///< number of boxes moved
  double furthest = 0;          ///< [m] largest displacement
};

/// Removes overlaps between boxes, and between boxes and walls, by translation only, changing no velocity: no
/// kinetic energy is added. Each pair is separated along the axis of least penetration, by the displacement
/// of least Σ mass · distance², where no box counts for more than 64 of the lightest. Fixed boxes stay. Where
/// an axis leaves no room, as down into the floor, the pair's next best is tried.
///
/// Along a fixed axis the gap of boxes that do not rotate is linear in their positions, so the least
/// displacement is a quadratic programme: that of DisplacementSolver, whose rows may not give way. They are
/// in order of the boxes' names, so the given order changes no bit. Pairs of `apart` may overlap.
///
/// InputError names a pair for which no room was found, and how much of it is missing.
Parted moveApart(std::span<const PlacedBox> boxes, std::span<const Wall> walls,
                 Meeting meeting = Meeting::kAll, ApartPairs apart = {});

}  // namespace careen
