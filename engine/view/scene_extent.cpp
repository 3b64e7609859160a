#include "view/scene_extent.h"

#include <algorithm>
#include <limits>

namespace careen {
namespace {

constexpr int kSamples = 60;

void include(Extent& extent, const Vec3& point, double radius) {
  extent.min = extent.min.cwiseMin(point - Vec3::Constant(radius));
  extent.max = extent.max.cwiseMax(point + Vec3::Constant(radius));
}

bool isBehindAWall(const Stage& stage, const Vec3& point, double time) {
  return std::any_of(stage.planes.begin(), stage.planes.end(), [&](const Plane& each) {
    const Plane wall = each.at(time);
    return wall.normal.dot(point) < wall.offset;
  });
}

void includeFlight(Extent& extent, const RunSetup& setup, const Body& box) {
  const double radius = radiusOf(box);
  for (int sample = 0; sample <= kSamples && !box.course.empty(); ++sample) {
    const double time = setup.settings.duration * sample / kSamples;
    include(extent, partAt(box.course, time).at(time).pose.position, radius);
  }
  Vec3 fallen = Vec3::Zero();
  Vec3 gained = Vec3::Zero();  // [m/s]
  double before = 0;
  for (int sample = 0; sample <= kSamples; ++sample) {
    const double time = setup.settings.duration * sample / kSamples;
    const Vec3 gain = (time - before) * meanGravity(setup.world, before, time);
    fallen += (time - before) * (gained + 0.5 * gain);
    gained += gain;
    before = time;
    const Vec3 point = box.initial.pose.position + time * box.initial.velocity + fallen;
    if (sample > 0 && (isImmovable(box.mass) || isBehindAWall(setup.stage, point, time))) {
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

Extent extentOf(const RunSetup& setup) {
  if (const std::optional<RoomShape>& room = setup.stage.room) {
    return {.min = room->min, .max = room->max};
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Extent extent{.min = Vec3::Constant(kInfinity), .max = Vec3::Constant(-kInfinity)};
  for (const Body& box : setup.world.bodies) {
    includeFlight(extent, setup, box);
  }
  for (const Spring& spring : setup.world.springs) {
    for (const SpringEnd& end : {spring.from, spring.to}) {
      if (!end.body) {
        include(extent, end.point, 0);
      }
    }
  }
  for (const Joint& joint : setup.world.joints) {
    if (!joint.to.body) {
      include(extent, joint.to.point, 0);
    }
  }
  if (!(extent.radius() > 0 && extent.radius() < kInfinity)) {  // empty or unbounded: use a default
    return {.min = Vec3::Constant(-1), .max = Vec3::Constant(1)};
  }
  return extent;
}

}  // namespace careen
