#include "view/wall_reach.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/stages.h"

namespace careen {
namespace {

// A cube of 1 m slides at 7 m/s without friction for 4 s.
Scene sliding() {
  Scene scene;
  scene.gravity = Vec3::Zero();
  scene.settings.duration = 4;
  scene.boxes.push_back(boxAt(Vec3(1, 2, 0.5), Vec3(0.5, 0.5, 0.5)));
  scene.boxes[0].velocity = Vec3(7, 0, 0);
  scene.walls.push_back(wallAt(Vec3::UnitZ(), 0));
  return scene;
}

TEST(WallReach, isAsFarAsABoxGoesInTheFilm) {
  const double radius = std::sqrt(0.75);
  Scene scene = sliding();
  const std::vector<WallReach> reaches = wallReachesOf(runOf(scene));
  ASSERT_EQ(reaches.size(), 1U);
  EXPECT_LT((reaches[0].min - Vec2(1 - radius, 2 - radius)).norm(), 1e-9);
  EXPECT_LT((reaches[0].max - Vec2(29 + radius, 2 + radius)).norm(), 1e-9);
  scene.timeMap.keys = {{.film = 0, .scene = 1}, {.film = 9, .scene = 2}};
  const std::vector<WallReach> shown = wallReachesOf(runOf(scene));
  EXPECT_NEAR(shown.at(0).min.x(), 8 - radius, 1e-9);
  EXPECT_NEAR(shown.at(0).max.x(), 15 + radius, 1e-9);
}

// The scene's radius is more than 14 m: what is 20 m above is not near, what is 5 m above is.
TEST(WallReach, countsOnlyWhatIsNearTheWall) {
  Scene scene = sliding();
  scene.walls.push_back(wallAt(Vec3::UnitZ(), -5));
  scene.walls.push_back(wallAt(Vec3::UnitZ(), -20));
  const std::vector<WallReach> reaches = wallReachesOf(runOf(scene));
  ASSERT_EQ(reaches.size(), 3U);
  EXPECT_FALSE(reaches[1].isEmpty());
  EXPECT_TRUE(reaches[2].isEmpty());
}

TEST(WallReach, isNotAskedWhereARoomBoundsTheWalls) {
  Scene scene = sliding();
  scene.room.emplace();
  scene.room->min = Vec3(-50, -50, -1);
  scene.room->max = Vec3(50, 50, 9);
  EXPECT_TRUE(wallReachesOf(runOf(scene)).empty());
}

TEST(WallReach, directionsLieInTheWallAndAreLevelAndUp) {
  for (const Vec3& normal :
       {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(0.6, 0, 0.8), Vec3(0, -0.8, 0.6)}) {
    const auto [across, along] = directionsOn(normal);
    EXPECT_NEAR(across.dot(normal), 0, 1e-15);
    EXPECT_LT((across.cross(along) - normal).norm(), 1e-15);
    EXPECT_NEAR(across.z(), 0, 1e-15);
    EXPECT_TRUE(isLevel(normal) || along.z() > 0);
  }
}

}  // namespace
}  // namespace careen
