#include "physics/impact/wall_contacts.h"

#include <algorithm>

#include "physics/geometry/separation.h"

namespace careen {
namespace {

// Calls add(corner) for those of a body of several boxes that are as low as its lowest, to `within` [m], if
// that touches the wall. Returns its gap.
template <class Add>
double addCornersAt(const Body& body, const Pose& pose, const WallPlane& wall, double within,
                    const Add& add) {
  std::vector<double> gaps;
  for (const Vec3& corner : body.partCorners) {
    gaps.push_back(cornerGap(pose, corner, wall.normal, wall.offset));
  }
  const double lowest = *std::min_element(gaps.begin(), gaps.end());
  for (std::size_t k = 0; k < gaps.size() && lowest <= within; ++k) {
    if (gaps[k] <= lowest + within) {
      add(static_cast<int>(k));
    }
  }
  return lowest;
}

}  // namespace

double addWallContacts(const World& world, const Body& body, const Pose& pose, int index, int firstWall,
                       std::vector<ImpactContact>& contacts, double time) {
  const double within = touchingWithin(boxAt(pose, body));
  double deepest = 0;
  for (std::size_t w = 0; w < world.walls.size(); ++w) {
    const Wall& wall = world.walls[w];
    const Pose frame = wallMotion(wall, time).pose;
    const WallPlane plane = planeOf(wall, frame);
    const auto add = [&](int k) {
      const Vec3 arm = pose.worldFromBody * corner(body, k);
      contacts.push_back(
          {.a = index,
           .b = firstWall + static_cast<int>(w),
           .armA = arm,
           .armB = wall.course.empty() ? Vec3(Vec3::Zero()) : Vec3((pose.position - frame.position) + arm),
           .normal = plane.normal,
           .material = touching(body.material, wall.material),
           .corner = k});
    };
    if (!body.parts.empty()) {
      deepest = std::max(deepest, -addCornersAt(body, pose, plane, within, add));
      continue;
    }
    const WallGap gap = wallGap(boxAt(pose, body), plane.normal, plane.offset, within);
    if (gap.gap > within) {
      continue;
    }
    deepest = std::max(deepest, -gap.gap);
    for (int k = 0; k < kCorners; ++k) {
      if ((gap.corners >> static_cast<unsigned>(k) & 1U) != 0) {
        add(k);
      }
    }
  }
  return deepest;
}

}  // namespace careen
