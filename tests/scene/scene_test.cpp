#include "scene/scene.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "physics/world/gap.h"

namespace careen {
namespace {

Scene roomAndRamp() {
  Scene scene;
  scene.room.emplace();
  scene.room->min = Vec3(-3, -2, 1);
  scene.room->max = Vec3(4, 5, 6);
  scene.room->material = {.restitution = 0.5, .friction = 0.25};
  scene.walls.push_back({.name = "ramp", .normal = Vec3::UnitZ(), .offset = 0.5, .material = {}});
  return scene;
}

std::vector<std::string> namesOf(const std::vector<Wall>& walls) {
  std::vector<std::string> names;
  names.reserve(walls.size());
  for (const Wall& wall : walls) {
    names.push_back(wall.name);
  }
  return names;
}

TEST(Scene, roomHasSixWallsThenComeThoseWrittenOut) {
  EXPECT_EQ(namesOf(wallsOf(roomAndRamp())),
            (std::vector<std::string>{"room-x", "room+x", "room-y", "room+y", "room-z", "room+z", "ramp"}));
  EXPECT_TRUE(wallsOf(Scene()).empty());
}

TEST(Scene, openSidesHaveNoWall) {
  Scene scene = roomAndRamp();
  scene.room->open = {false, true, false, false, true, false};
  EXPECT_EQ(namesOf(wallsOf(scene)),
            (std::vector<std::string>{"room-x", "room-y", "room+y", "room+z", "ramp"}));
}

TEST(Scene, roomWallsFaceInward) {
  const std::vector<Wall> walls = wallsOf(roomAndRamp());
  // From the point (0, 1, 2): 3 m to x = -3, 4 m to x = 4, and so on.
  const std::vector<double> distances = {3, 4, 3, 4, 1, 4};
  for (std::size_t side = 0; side < distances.size(); ++side) {
    EXPECT_EQ(gap(walls[side], Vec3(0, 1, 2)), distances[side]) << walls[side].name;
    EXPECT_EQ(walls[side].normal.norm(), 1);
    EXPECT_EQ(walls[side].material.restitution, 0.5);
    EXPECT_EQ(walls[side].material.friction, 0.25);
  }
}

}  // namespace
}  // namespace careen
