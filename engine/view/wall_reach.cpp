#include "view/wall_reach.h"

#include <algorithm>
#include <cmath>

#include "view/scene_extent.h"

namespace careen {

bool isLevel(const Vec3& normal) { return std::abs(normal.z()) > 0.999; }

std::pair<Vec3, Vec3> directionsOn(const Vec3& normal) {
  const Vec3 across =
      (isLevel(normal) ? Vec3::UnitY().cross(normal) : Vec3::UnitZ().cross(normal)).normalized();
  return {across, normal.cross(across)};
}

std::pair<Vec3, Vec3> directionsOn(const Plane& wall, double time) {
  const auto [across, along] = directionsOn(wall.at(0).normal);
  if (wall.course.empty()) {
    return {across, along};
  }
  const Mat3 turned = wall.frameAt(time).worldFromBody * wall.frameAt(0).worldFromBody.transpose();
  return {turned * across, turned * along};
}

void WallReach::add(const Vec2& place, double radius) {
  const Vec2 low = place.array() - radius;
  const Vec2 high = place.array() + radius;
  min = isEmpty() ? low : Vec2(min.cwiseMin(low));
  max = isEmpty() ? high : Vec2(max.cwiseMax(high));
}

std::vector<WallReach> wallReachesOf(const Trajectory& run) {
  constexpr std::size_t kMostPoses = 200'000;  // evaluated in a fraction of a second
  constexpr double kNear = 0.5;                // [1] of the radius of the scene
  const std::vector<Plane>& walls = run.stage.planes;
  if (run.stage.room || walls.empty() || run.world.bodies.empty()) {
    return {};
  }
  const double near = kNear * extentOf(run).radius();
  const TimeMap clock = run.stage.timeMap.within(run.settings.duration);
  const std::size_t moments = std::clamp<std::size_t>(kMostPoses / run.world.bodies.size(), 60, 600);
  std::vector<WallReach> reaches(walls.size());
  for (std::size_t moment = 0; moment < moments; ++moment) {
    const double part = static_cast<double>(moment) / static_cast<double>(moments - 1);
    const double time = clock.sceneTime(part * clock.duration());
    const std::vector<Pose> poses = run.poses(time);
    for (std::size_t body = 0; body < poses.size(); ++body) {
      const Vec3& at = poses[body].position;
      const double radius = run.world.bodies[body].halfExtents.norm();
      for (std::size_t wall = 0; wall < walls.size(); ++wall) {
        const Plane plane = walls[wall].at(time);
        if (plane.normal.dot(at) - plane.offset < near + radius) {
          const auto [across, along] = directionsOn(walls[wall], time);
          reaches[wall].add(Vec2(across.dot(at), along.dot(at)), radius);
        }
      }
    }
  }
  return reaches;
}

}  // namespace careen
