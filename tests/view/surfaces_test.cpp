#include "view/surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/stages.h"

namespace careen {
namespace {

double areaAlong(const Surface& surface, const Vec3& normal) {
  Vec3 twice = Vec3::Zero();
  for (std::size_t i = 0; i < surface.outline.size(); ++i) {
    twice += surface.outline[i].cross(surface.outline[(i + 1) % surface.outline.size()]);
  }
  return 0.5 * twice.dot(normal);
}

TEST(Surfaces, roomHasItsClosedSidesOnly) {
  const Scene scene = crateInRoom();
  const std::vector<Surface> surfaces = surfacesOf(stageOf(scene), extentOf(setupOf(scene)));
  ASSERT_EQ(surfaces.size(), 4U);
  for (const Surface& surface : surfaces) {
    EXPECT_NE(surface.normal, Vec3(0, 1, 0));   // -y is open
    EXPECT_NE(surface.normal, Vec3(0, 0, -1));  // +z is open
  }
}

// What is drawn of a wall that moves is where it is then, within the scene; its tiles go with it.
TEST(Surfaces, ofAWallThatMovesAreWhereItIs) {
  Stage stage;
  stage.planes = {{.normal = Vec3::UnitZ(),
                   .course = courseOf({.path = {},
                                       .velocity = Vec3(0.5, 0, 0.25),
                                       .angularVelocity = Vec3(0, 0.5, 0),
                                       .about = Vec3::Zero()},
                                      {})}};
  const Extent extent{.min = Vec3::Constant(-2), .max = Vec3::Constant(2)};
  const Surface first = surfacesOf(stage, extent).at(0);
  const Surface then = surfacesOf(stage, extent, {}, {}, 0.5).at(0);
  EXPECT_EQ(then.plane, 0);
  const Plane plane = stage.planes[0].at(0.5);
  EXPECT_LT((then.normal - Vec3(std::sin(0.25), 0, std::cos(0.25))).norm(), 1e-15);
  for (const Vec3& corner : then.outline) {
    EXPECT_NEAR(plane.normal.dot(corner), plane.offset, 1e-14);
  }
  EXPECT_GT(areaAlong(then, then.normal), 16);
  EXPECT_LT((then.origin - (Vec3(0.25, 0, 0.125) + first.origin)).norm(), 1e-15);
  EXPECT_NEAR(then.across.dot(then.normal), 0, 1e-15);
  EXPECT_NEAR(std::abs(then.across.dot(first.across)), std::cos(0.25), 1e-15);
}

// Anticlockwise from inside: the area along the normal is the side's own, and positive.
TEST(Surfaces, sidesFaceInwardWithTheirWholeArea) {
  Scene scene = crateInRoom();
  scene.room->open = {};
  for (const Surface& surface : surfacesOf(stageOf(scene), extentOf(setupOf(scene)))) {
    const Vec3 inward = extentOf(setupOf(scene)).centre() - surface.origin;
    EXPECT_GT(inward.dot(surface.normal), 0);
    const Vec3 size = Vec3(6, 4, 3);
    const double area = 72 / std::abs(surface.normal.dot(size));
    EXPECT_NEAR(areaAlong(surface, surface.normal), area, 1e-12);
    EXPECT_NEAR(surface.size.x() * surface.size.y(), area, 1e-12);
    for (const Vec3& corner : surface.outline) {
      EXPECT_NEAR((corner - surface.origin).dot(surface.normal), 0, 1e-15);
      EXPECT_GE((corner - surface.origin).dot(surface.across), 0);
      EXPECT_GE((corner - surface.origin).dot(surface.along), 0);
    }
  }
}

TEST(Surfaces, wallsStandUprightOnTheFloor) {
  const Scene scene = crateInRoom();
  for (const Surface& surface : surfacesOf(stageOf(scene), extentOf(setupOf(scene)))) {
    if (surface.covering == Covering::kSkirted) {
      EXPECT_EQ(surface.along, Vec3::UnitZ());
      EXPECT_EQ(surface.origin.z(), 0);
      EXPECT_TRUE(surface.adjoins[2]);   // the floor
      EXPECT_FALSE(surface.adjoins[3]);  // open above
    }
  }
}

// The plane x + z = 1 cuts a cube of side 2 about the origin in a rectangle, from (0,·,1) to (1,·,0): 2√2 m².
TEST(Surfaces, furtherWallIsCutToTheRoom) {
  Scene scene;
  scene.room.emplace();
  scene.room->min = Vec3::Constant(-1);
  scene.room->max = Vec3::Constant(1);
  scene.room->open.fill(true);
  const double half = std::sqrt(0.5);
  scene.walls.push_back(wallAt(Vec3(-half, 0, -half), -half));
  const std::vector<Surface> surfaces = surfacesOf(stageOf(scene), extentOf(setupOf(scene)));
  ASSERT_EQ(surfaces.size(), 1U);
  EXPECT_NEAR(areaAlong(surfaces[0], surfaces[0].normal), 2 * std::sqrt(2.0), 1e-12);
  for (const Vec3& corner : surfaces[0].outline) {
    EXPECT_NEAR(corner.x() + corner.z(), 1, 1e-12);
    EXPECT_LE(corner.cwiseAbs().maxCoeff(), 1 + 1e-12);
  }
}

TEST(Surfaces, wallOutsideTheRoomIsNotThere) {
  Scene scene = crateInRoom();
  scene.room->open.fill(true);
  scene.walls.push_back(wallAt(Vec3::UnitZ(), -100));
  EXPECT_TRUE(surfacesOf(stageOf(scene), extentOf(setupOf(scene))).empty());
}

TEST(Surfaces, floorWithoutRoomReachesBeyondTheScene) {
  Scene scene;
  scene.boxes.push_back(boxAt(Vec3(0, 0, 1), Vec3(0.5, 0.5, 0.5)));
  scene.walls.push_back(wallAt(Vec3::UnitZ(), 0));
  const Extent extent = extentOf(setupOf(scene));
  const std::vector<Surface> surfaces = surfacesOf(stageOf(scene), extent);
  ASSERT_EQ(surfaces.size(), 1U);
  double reach = 0;
  for (const Vec3& corner : surfaces[0].outline) {
    EXPECT_NEAR(corner.z(), 0, 1e-12);
    reach = std::max(reach, corner.x());
  }
  EXPECT_GT(reach, extent.max.x());
}

Scene boxOverFloor() {
  Scene scene;
  scene.boxes.push_back(boxAt(Vec3(0, 0, 1), Vec3(0.5, 0.5, 0.5)));
  scene.walls.push_back(wallAt(Vec3::UnitZ(), 0));
  return scene;
}

TEST(Surfaces, floorThatReachesFarEnoughStaysAsItIs) {
  const RunSetup setup = setupOf(boxOverFloor());
  const Extent extent = extentOf(setup);
  const WallReach within{.min = Vec2(-1, -1), .max = Vec2(1, 1)};
  const Surface known = surfacesOf(setup.stage, extent).at(0);
  const Surface told = surfacesOf(setup.stage, extent, {}, {&within, 1}).at(0);
  EXPECT_EQ(told.outline, known.outline);
  EXPECT_EQ(told.fade, 0);
}

// To x = 28 and its own ends elsewhere, with a margin on each side that is as wide as the scene's radius.
TEST(Surfaces, floorReachesAsFarAsBoxesGo) {
  const RunSetup setup = setupOf(boxOverFloor());
  const Extent extent = extentOf(setup);
  const WallReach far{.min = Vec2(-1, -1), .max = Vec2(28, 1)};
  const Surface known = surfacesOf(setup.stage, extent).at(0);
  const Surface told = surfacesOf(setup.stage, extent, {}, {&far, 1}).at(0);
  Extent before{.min = known.outline[0], .max = known.outline[0]};
  for (const Vec3& corner : known.outline) {
    before = {.min = before.min.cwiseMin(corner), .max = before.max.cwiseMax(corner)};
  }
  Extent after{.min = told.outline.at(0), .max = told.outline.at(0)};
  for (const Vec3& corner : told.outline) {
    after = {.min = after.min.cwiseMin(corner), .max = after.max.cwiseMax(corner)};
  }
  const double margin = extent.radius();
  EXPECT_EQ(told.fade, margin);
  EXPECT_LT((after.max - Vec3(28 + margin, before.max.y() + margin, 0)).norm(), 1e-12);
  EXPECT_LT((after.min - Vec3(before.min.x() - margin, before.min.y() - margin, 0)).norm(), 1e-12);
  EXPECT_EQ(told.outline.size(), 4U);
  EXPECT_GT(areaAlong(told, told.normal), 0);
  EXPECT_EQ(told.origin, known.origin);  // tiles stay where they are
}

// A wall that the scene does not reach, but a box does later.
TEST(Surfaces, wallAwayFromTheSceneIsThereIfABoxGoesThere) {
  Scene scene = boxOverFloor();
  scene.walls.push_back(wallAt(-Vec3::UnitX(), -100));
  const RunSetup setup = setupOf(scene);
  EXPECT_EQ(surfacesOf(setup.stage, extentOf(setup)).size(), 1U);
  const std::vector<WallReach> reaches = {{}, {.min = Vec2(-0.5, 0), .max = Vec2(0.5, 1)}};
  const std::vector<Surface> surfaces = surfacesOf(setup.stage, extentOf(setup), {}, reaches);
  ASSERT_EQ(surfaces.size(), 2U);
  for (const Vec3& corner : surfaces[1].outline) {
    EXPECT_NEAR(corner.x(), 100, 1e-12);
  }
}

TEST(Surfaces, tilesSuitTheScene) {
  EXPECT_DOUBLE_EQ(tileSize(extentOf(setupOf(crateInRoom()))), 0.5);
  EXPECT_DOUBLE_EQ(tileSize({.min = Vec3::Zero(), .max = Vec3(600, 400, 300)}), 50);
  EXPECT_DOUBLE_EQ(tileSize({.min = Vec3::Zero(), .max = Vec3(0.2, 0.2, 0.2)}), 0.02);
}

}  // namespace
}  // namespace careen
