#include "physics/impact/wall_contacts.h"

#include <algorithm>

#include "physics/geometry/separation.h"

namespace careen {

double addWallContacts(const World& world, const Body& body, const Pose& pose, int index, int firstWall,
                       std::vector<ImpactContact>& contacts) {
  const double within = touchingWithin(boxAt(pose, body));
  double deepest = 0;
  for (std::size_t w = 0; w < world.walls.size(); ++w) {
    const Wall& wall = world.walls[w];
    const WallGap gap = wallGap(boxAt(pose, body), wall.normal, wall.offset, within);
    if (gap.gap > within) {
      continue;
    }
    deepest = std::max(deepest, -gap.gap);
    for (int k = 0; k < kCorners; ++k) {
      if ((gap.corners >> static_cast<unsigned>(k) & 1U) != 0) {
        contacts.push_back({.a = index,
                            .b = firstWall + static_cast<int>(w),
                            .armA = pose.worldFromBody * corner(body, k),
                            .normal = wall.normal,
                            .material = touching(body.material, wall.material),
                            .corner = k});
      }
    }
  }
  return deepest;
}

}  // namespace careen
