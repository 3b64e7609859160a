#include "scene/scene.h"

namespace careen {
namespace {

std::vector<Wall> wallsOf(const Room& room) {
  std::vector<Wall> walls;
  for (std::size_t side = 0; side < kRoomSides.size(); ++side) {
    if (room.open[side]) {
      continue;
    }
    const auto axis = static_cast<Eigen::Index>(side / 2);
    const bool upper = side % 2 == 1;
    const Vec3 unit = Vec3::Unit(axis);
    walls.push_back({.name = roomWallName(side),
                     .normal = upper ? Vec3(-unit) : unit,
                     .offset = upper ? -room.max[axis] : room.min[axis],
                     .material = room.material});
  }
  return walls;
}

}  // namespace

std::string roomWallName(std::size_t side) { return std::string("room") + kRoomSides.at(side); }

std::vector<Wall> wallsOf(const Scene& scene) {
  std::vector<Wall> walls = scene.room ? wallsOf(*scene.room) : std::vector<Wall>();
  walls.insert(walls.end(), scene.walls.begin(), scene.walls.end());
  return walls;
}

}  // namespace careen
