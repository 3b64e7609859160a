#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/math/linear_algebra.h"
#include "stage/stage.h"
#include "view/materials.h"
#include "view/scene_extent.h"
#include "view/wall_reach.h"

namespace careen {

/// Pattern on a flat surface.
enum class Covering { kPlain, kSkirted, kTiles };

/// A flat convex piece of floor or wall, seen from the side its normal points to.
struct Surface {
  std::vector<Vec3> outline;  ///< [m] world; counterclockwise seen from that side
  Vec3 normal = Vec3::UnitZ();
  Vec3 origin = Vec3::Zero();     ///< [m] the point of the surface where both coordinates are 0
  Vec3 across = Vec3::UnitX();    ///< direction of the first coordinate; horizontal on a wall
  Vec3 along = Vec3::UnitY();     ///< direction of the second; upward on a wall
  Vec3 size = Vec3::Zero();       ///< [m] of a room's side: extent of both coordinates; 0 if not a rectangle
  std::array<bool, 4> adjoins{};  ///< whether another surface adjoins at the start and end of the first
                                  ///< coordinate, and of the second
  Covering covering = Covering::kPlain;
  Vec3 color = Vec3::Ones();  ///< linear
  double fade = 0;            ///< [m] from the end of a rectangle, where it fades into the background; 0: not
  int plane = -1;             ///< index of the stage's plane if that moves by itself: the outline may be empty
};

/// The part of a convex outline where normal·x >= offset.
std::vector<Vec3> clipped(const std::vector<Vec3>& outline, const Vec3& normal, double offset);

/// Side length of tiles that suits this extent: 1, 2 or 5 times a power of ten [m].
double tileSize(const Extent& extent);

/// Floor and walls: the room's closed sides, and the part of every other wall within the extent and, if it is
/// told, as far as boxes go along it. Walls that move by themselves are where they are at that time [s].
std::vector<Surface> surfacesOf(const Stage& stage, const Extent& extent, const Materials& materials = {},
                                std::span<const WallReach> reaches = {}, double time = 0);

}  // namespace careen
