#include "render/draw/drawn_box.h"

#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "render/stage.h"
#include "view/materials.h"

namespace careen {
namespace {

std::vector<DrawnBox> drawnOf(const Scene& scene, std::span<const Pose> poses, double springThickness) {
  const RunSetup setup = setupOf(scene);
  return drawnBoxes(setup.world, setup.stage, poses, springThickness);
}

// The crate, then a spring from its corner to (2, 0, 1): from (0.5, 0.3, 0.2) beside its centre (0, 0, 1).
TEST(DrawnBox, hasTheBoxesThenTheirSpringsAsRods) {
  Scene scene = crateInRoom();
  scene.boxes[0].pose = {.position = {0, 0, 1}};
  scene.springs = {
      {.from = {.body = 0, .point = {0.5, 0.3, 0.2}}, .to = {.body = {}, .point = {2.5, 0.3, 1.2}}}};
  const std::vector<DrawnBox> boxes = drawnOf(scene, posesOf(scene), 0.1);
  ASSERT_EQ(boxes.size(), 2U);
  EXPECT_TRUE(boxes[0].marked);
  EXPECT_EQ(boxes[0].halfExtents, Vec3(0.5, 0.3, 0.2));
  EXPECT_EQ(boxes[0].color, linearFromSrgb({200, 85, 61}));
  EXPECT_FALSE(boxes[1].marked);
  EXPECT_LT((boxes[1].pose.position - Vec3(1.5, 0.3, 1.2)).norm(), 1e-15);
  EXPECT_LT((boxes[1].halfExtents - Vec3(1, 0.05, 0.05)).norm(), 1e-15);
  EXPECT_LT((boxes[1].pose.worldFromBody.col(0).cwiseAbs() - Vec3::UnitX()).norm(), 1e-15);
}

TEST(DrawnBox, leavesOutRodsTooShortToBeSeen) {
  Scene scene = crateInRoom();
  scene.springs = {{.from = {.body = {}, .point = {1, 0, 0}}, .to = {.body = {}, .point = {1.009, 0, 0}}}};
  EXPECT_EQ(drawnOf(scene, posesOf(scene), 0.1).size(), 1U);
  EXPECT_EQ(drawnOf(scene, posesOf(scene), 0.05).size(), 2U);
}

// Three moments of two boxes, of which the second rests: it is there once.
TEST(DrawnBox, ofSeveralMomentsHasWhatRestsOnce) {
  Scene scene = crateInRoom();
  scene.boxes.push_back(boxAt(Vec3(2, 0, 1), Vec3::Ones()));
  std::vector<Pose> poses;
  for (const double x : {0.0, 0.1, 0.2}) {
    poses.push_back({.position = {x, 0, 1}});
    poses.push_back({.position = {2, 0, 1}});
  }
  EXPECT_EQ(drawnOf(scene, poses, 0.1).size(), 4U);
}

// A bar and a head of it, turned by 90° about z, on a body that is itself turned by 90° about x: parts are
// where their body takes them, without marks, and count by themselves; what rests is there once.
TEST(DrawnBox, partsAreBoxesOfTheirBody) {
  Scene scene = crateInRoom();
  SceneBox& hammer = scene.boxes.emplace_back(boxAt(Vec3(1, 0, 2), Vec3(0.7, 0.6, 0.2)));
  hammer.pose.worldFromBody << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  BodyPart bar{.halfExtents = Vec3(0.5, 0.1, 0.1)};
  BodyPart head{.halfExtents = Vec3(0.6, 0.2, 0.2), .turned = true};
  head.bodyFromPart << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  head.center = head.bodyFromPart.transpose() * Vec3(0.5, 0, 0);
  hammer.parts = {bar, head};
  scene.boxes.push_back(boxAt(Vec3(-1.5, 0, 2), Vec3(0.1, 0.1, 0.1)));
  std::vector<Pose> poses = posesOf(scene);
  const std::vector<DrawnBox> boxes = drawnOf(scene, poses, 0.1);
  ASSERT_EQ(boxes.size(), 4U);
  EXPECT_EQ(boxes[1].halfExtents, Vec3(0.5, 0.1, 0.1));
  EXPECT_EQ(boxes[2].halfExtents, Vec3(0.6, 0.2, 0.2));
  EXPECT_LT((boxes[1].pose.position - Vec3(1, 0, 2)).norm(), 1e-15);
  EXPECT_LT((boxes[2].pose.position - Vec3(1.5, 0, 2)).norm(), 1e-15);
  // The head's x is the body's y, which is the world's z.
  EXPECT_LT((boxes[2].pose.worldFromBody.col(0) - Vec3::UnitZ()).norm(), 1e-15);
  EXPECT_EQ(boxes[1].color, boxes[2].color);
  EXPECT_TRUE(boxes[0].marked && boxes[3].marked);
  EXPECT_FALSE(boxes[1].marked || boxes[2].marked);
  EXPECT_FALSE(haveCopies(boxes));
  EXPECT_EQ(boxes[3].shown, 3U);
  const std::vector<Pose> now = poses;
  poses.insert(poses.end(), now.begin(), now.end());
  poses[4].position.x() += 0.1;  // the hammer, at the second moment
  const std::vector<DrawnBox> twice = drawnOf(scene, poses, 0.1);
  ASSERT_EQ(twice.size(), 6U);
  EXPECT_TRUE(haveCopies(twice));
  EXPECT_EQ(twice[5].moment, 1U);
  EXPECT_EQ(twice[5].shown, 2U);
}

// A cube 10 m before the eye, where a pixel is 1 cm wide; its sides are seen from a metre to the right.
TEST(DrawnBox, facesAreThoseThatTheEyeSees) {
  DrawnBox box{.pose = {}, .halfExtents = Vec3(0.5, 0.5, 0.5)};
  const std::vector<DrawnFace> faces = facesTowards({&box, 1}, Vec3(1, -10, 0), 1e-3);
  ASSERT_EQ(faces.size(), 2U);
  EXPECT_EQ(faces[0].side, 0);  // +x
  EXPECT_EQ(faces[1].side, 3);  // -y
  EXPECT_EQ(faces[1].normal, -Vec3::UnitY());
  EXPECT_NEAR(faces[1].width, 100, 2);
  EXPECT_NEAR(faces[0].width, 100 * 0.5 / 10, 0.5);
  const std::vector<DrawnFace> thin = facesTowards({&box, 1}, Vec3(0.5 + 1e-3, -10, 0), 1e-3);
  ASSERT_EQ(thin.size(), 2U);  // a hundredth of a pixel of +x: lit like -y
  EXPECT_EQ(thin[0].normal, thin[1].normal);
  EXPECT_TRUE(facesTowards({&box, 1}, Vec3(0.1, 0.1, 0.1), 1e-3).empty());  // from inside
}

TEST(DrawnBox, copiesAreSeveralOfOneBody) {
  std::vector<DrawnBox> boxes(3);
  boxes[1].shown = 2;
  boxes[2].shown = 1;
  EXPECT_FALSE(haveCopies({}));
  EXPECT_FALSE(haveCopies(boxes));
  boxes[2].shown = 0;
  EXPECT_TRUE(haveCopies(boxes));
}

}  // namespace
}  // namespace careen
