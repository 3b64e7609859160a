#include "render/view/scene_extent.h"

#include <algorithm>
#include <limits>

namespace careen {
namespace {

constexpr int kSamples = 60;

void include(Extent& extent, const Vec3& point, double radius) {
  extent.min = extent.min.cwiseMin(point - Vec3::Constant(radius));
  extent.max = extent.max.cwiseMax(point + Vec3::Constant(radius));
}

bool isBehindAWall(const Scene& scene, const Vec3& point) {
  return std::any_of(scene.walls.begin(), scene.walls.end(),
                     [&](const Wall& wall) { return wall.normal.dot(point) < wall.offset; });
}

void includeFlight(Extent& extent, const Scene& scene, const SceneBox& box) {
  const double radius = box.halfExtents.norm();
  for (int sample = 0; sample <= kSamples; ++sample) {
    const double time = scene.duration * sample / kSamples;
    const Vec3 point = box.pose.position + time * box.velocity + 0.5 * time * time * scene.gravity;
    if (sample > 0 && (box.fixed || isBehindAWall(scene, point))) {
      return;
    }
    include(extent, point, radius);
  }
}

}  // namespace

Vec3 Extent::corner(int index) const {
  return {(index & 4) == 0 ? max.x() : min.x(), (index & 2) == 0 ? max.y() : min.y(),
          (index & 1) == 0 ? max.z() : min.z()};
}

Extent extentOf(const Scene& scene) {
  if (scene.room) {
    return {.min = scene.room->min, .max = scene.room->max};
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Extent extent{.min = Vec3::Constant(kInfinity), .max = Vec3::Constant(-kInfinity)};
  for (const SceneBox& box : scene.boxes) {
    includeFlight(extent, scene, box);
  }
  for (const Spring& spring : scene.springs) {
    for (const SpringEnd& end : {spring.from, spring.to}) {
      if (!end.body) {
        include(extent, end.point, 0);
      }
    }
  }
  if (!(extent.radius() > 0 && extent.radius() < kInfinity)) {  // nothing to see: show where it would be
    return {.min = Vec3::Constant(-1), .max = Vec3::Constant(1)};
  }
  return extent;
}

}  // namespace careen
