#include "scene/starts.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "physics/world/method.h"

namespace careen {
namespace {

// Two cubes of half size 1, overlapping by 0.5 m along x; the first one by 0.25 m in the floor.
Scene overlapping(Method method) {
  Scene scene;
  scene.settings.method = method;
  scene.walls.push_back({.name = "floor", .normal = Vec3::UnitZ(), .offset = 0, .material = {}});
  for (const double x : {0.0, 1.5}) {
    SceneBox box;
    box.name = x == 0 ? "left" : "right";
    box.halfExtents = Vec3::Ones();
    box.mass = 1;
    box.pose.position = {x, 0, x == 0 ? 0.75 : 5.0};
    scene.boxes.push_back(box);
  }
  scene.boxes[1].pose.position.z() = 0.75;
  return scene;
}

TEST(Starts, findWhatOverlapsWhereBoxesMayMeet) {
  ASSERT_TRUE(traitsOf(Method::kExact).boxBox);
  ASSERT_FALSE(traitsOf(Method::kListing1).boxBox);
  EXPECT_TRUE(findOverlap(overlapping(Method::kExact)).has_value());
  EXPECT_FALSE(findOverlap(overlapping(Method::kListing1)).has_value());
  Scene apart = overlapping(Method::kExact);
  apart.boxes[1].pose.position.x() = 3;
  EXPECT_FALSE(findOverlap(apart).has_value());
}

TEST(Starts, areMovedApartAndOutOfWalls) {
  Scene scene = overlapping(Method::kExact);
  EXPECT_THROW(checkApart(scene), InputError);
  moveApart(scene);
  EXPECT_FALSE(findOverlap(scene).has_value());
  EXPECT_NO_THROW(checkApart(scene));
  for (const SceneBox& box : scene.boxes) {
    EXPECT_GE(box.pose.position.z(), 1 - 1e-12);
  }
}

TEST(Starts, ofAMethodThatKnowsNoBoxesAreMovedOutOfWallsOnly) {
  Scene scene = overlapping(Method::kListing1);
  moveApart(scene);
  EXPECT_EQ(scene.boxes[1].pose.position.x(), 1.5);
  EXPECT_GE(scene.boxes[0].pose.position.z(), 1 - 1e-12);
}

TEST(Starts, whatPassesThroughMayOverlap) {
  Scene scene = overlapping(Method::kExact);
  scene.apart = {{0, 1}};
  EXPECT_FALSE(findOverlap(scene).has_value());
  moveApart(scene);
  EXPECT_EQ(scene.boxes[1].pose.position.x(), 1.5);
}

TEST(Starts, whatIsJoinedIsNotMoved) {
  Scene scene = overlapping(Method::kExact);
  Joint joint{.name = "leash", .kind = Joint::Kind::kRope, .from = {.body = 1}, .to = {}, .length = 9};
  scene.joints.push_back(joint);
  EXPECT_THROW(moveApart(scene), InputError);
  scene.boxes[1].pose.position = {5, 0, 2};
  EXPECT_NO_THROW(moveApart(scene));  // the other one is in the floor
}

TEST(Starts, whatIsHeldStays) {
  Scene scene = overlapping(Method::kExact);
  scene.boxes[0].fixed = true;
  scene.boxes[0].pose.position.z() = 1;
  moveApart(scene);
  EXPECT_EQ(scene.boxes[0].pose.position, Vec3(0, 0, 1));
  EXPECT_FALSE(findOverlap(scene).has_value());
}

}  // namespace
}  // namespace careen
