#pragma once

#include <vector>

#include "core/math/linear_algebra.h"
#include "render/look/materials.h"
#include "render/view/scene_extent.h"
#include "stage/stage.h"

namespace careen {

/// What is laid on a flat surface.
enum class Covering { kPlain, kSkirted, kTiles };

/// A flat convex piece of floor or wall, seen from the side its normal points to.
struct Surface {
  std::vector<Vec3> outline;  ///< [m] world; anticlockwise as seen from that side
  Vec3 normal = Vec3::UnitZ();
  Vec3 origin = Vec3::Zero();   ///< [m] a point of the surface where both coordinates are 0
  Vec3 across = Vec3::UnitX();  ///< first coordinate's direction; horizontal on a wall
  Vec3 along = Vec3::UnitY();   ///< second coordinate's; upward on a wall
  Vec3 size =
      Vec3::Zero();  ///< [m] of a room's side: extent of both coordinates; 0 where there is no rectangle
  std::array<bool, 4> adjoins{};  ///< whether another surface meets it where the first coordinate is 0, is at
                                  ///< its end, where the second is 0, is at its end
  Covering covering = Covering::kPlain;
  Vec3 color = Vec3::Ones();  ///< linear
};

/// Length of a tile's side that suits a scene of this extent: 1, 2 or 5 times a power of ten [m].
double tileSize(const Extent& extent);

/// Floor and walls: the room's closed sides, and of every further wall what lies within the extent.
std::vector<Surface> surfacesOf(const Stage& stage, const Extent& extent, const Materials& materials = {});

}  // namespace careen
