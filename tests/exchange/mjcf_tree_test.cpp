#include "exchange/mjcf_tree.h"

#include <gtest/gtest.h>

#include <vector>

namespace careen {
namespace {

using JointKind = Joint::Kind;

// `fixed` of the bodies are immovable.
World worldOfJoints(int bodies, int fixed, std::vector<Joint> joints) {
  World world;
  for (int i = 0; i < bodies; ++i) {
    world.bodies.push_back({.name = std::to_string(i),
                            .halfExtents = Vec3::Ones(),
                            .mass = i < fixed ? immovable() : solidBox(Vec3::Ones(), 1),
                            .material = {},
                            .initial = {}});
  }
  world.joints = std::move(joints);
  return world;
}
Joint jointBetween(JointKind kind, int from, std::optional<int> to) {
  Joint made{.name = {}, .kind = kind, .from = {}, .to = {}};
  made.from.body = from;
  made.to.body = to;
  return made;
}

// 4 – 2 – 0, 3 – 2, and 1 alone: from the least of what nothing holds.
TEST(MjcfTree, bodiesHangOnTheFirstOfThem) {
  const World world =
      worldOfJoints(5, 0,
                    {jointBetween(JointKind::kBall, 4, 2), jointBetween(JointKind::kBall, 0, 2),
                     jointBetween(JointKind::kBall, 2, 3)});
  const MjcfTree tree = treeOf(world);
  EXPECT_EQ(tree.parent, (std::vector<std::optional<int>>{{}, {}, 0, 2, 2}));
  EXPECT_EQ(tree.joint, (std::vector<std::optional<std::size_t>>{{}, {}, 1U, 2U, 0U}));
  EXPECT_EQ(tree.order, (std::vector<int>{0, 2, 3, 4, 1}));
  EXPECT_TRUE(tree.closing.empty());
  EXPECT_TRUE(tree.isFree(world, 1));
  EXPECT_FALSE(tree.isFree(world, 2));
  EXPECT_TRUE(tree.areJoined(2, 4));
  EXPECT_FALSE(tree.areJoined(3, 4));
  EXPECT_FALSE(tree.areJoined(0, 4));
}

// Four hinges about 0, which is fixed, 1, 2 and 3; 3 is held by the world too.
TEST(MjcfTree, loopsAreClosedByTheLeastOfTheirJoints) {
  World world =
      worldOfJoints(4, 1,
                    {jointBetween(JointKind::kHinge, 1, 0), jointBetween(JointKind::kHinge, 2, 1),
                     jointBetween(JointKind::kHinge, 2, 3), jointBetween(JointKind::kHinge, 3, {})});
  EXPECT_EQ(treeOf(world).closing, std::vector<std::size_t>{3});
  world.joints[3].damping = 1;  // what only a joint of the tree can have
  EXPECT_EQ(treeOf(world).closing, std::vector<std::size_t>{2});
  world.joints[2].kind = JointKind::kSlider;
  EXPECT_EQ(treeOf(world).closing, std::vector<std::size_t>{1});
  world.control = Control{.period = 1, .motors = {{.joint = 1}}};
  EXPECT_EQ(treeOf(world).closing, std::vector<std::size_t>{0});
  world.joints[0].kind = JointKind::kFixed;
  world.control.reset();
  const MjcfTree tree = treeOf(world);
  EXPECT_EQ(tree.closing, std::vector<std::size_t>{1});
  EXPECT_EQ(tree.parent, (std::vector<std::optional<int>>{{}, 0, 3, {}}));
  EXPECT_EQ(tree.oneWith, (std::vector<std::optional<int>>{{}, {}, 2, 3}));
}

// 0 – 1 = 2 – 3: 1 and 2 are one, in 0, and 3 is in them.
TEST(MjcfTree, bodiesThatAreFixedToEachOtherAreOne) {
  const MjcfTree tree =
      treeOf(worldOfJoints(4, 0,
                           {jointBetween(JointKind::kHinge, 1, 0), jointBetween(JointKind::kFixed, 2, 1),
                            jointBetween(JointKind::kBall, 3, 2)}));
  EXPECT_EQ(tree.oneWith, (std::vector<std::optional<int>>{0, 1, 1, 3}));
  EXPECT_TRUE(tree.areJoined(1, 2));
  EXPECT_TRUE(tree.areJoined(0, 2));
  EXPECT_TRUE(tree.areJoined(1, 3));
  EXPECT_FALSE(tree.areJoined(0, 3));
}

TEST(MjcfTree, ropesAndRodsHoldNothingInIt) {
  const MjcfTree tree = treeOf(
      worldOfJoints(2, 0, {jointBetween(JointKind::kRope, 1, 0), jointBetween(JointKind::kRod, 1, 0)}));
  EXPECT_EQ(tree.order, (std::vector<int>{0, 1}));
  EXPECT_FALSE(tree.joint[1]);
  EXPECT_TRUE(tree.closing.empty());
}

}  // namespace
}  // namespace careen
