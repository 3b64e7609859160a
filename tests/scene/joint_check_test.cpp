#include "scene/joint_check.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/scene_reader.h"
#include "support/input_error.h"
#include "support/scenes.h"

namespace careen {
namespace {

Pose poseOf(const Scene& scene, const JointEnd& end) {
  return end.body ? scene.boxes[static_cast<std::size_t>(*end.body)].pose : Pose{};
}

// The crate's x axis is the world's y, its y axis the world's -x.
TEST(JointCheck, endsAreInFramesOfTheirBoxes) {
  const Scene scene = parseScene(kJoints, "f");
  const Joint& knee = scene.joints[0];
  EXPECT_EQ(knee.from.body, 1);
  EXPECT_EQ(knee.to.body, 0);
  EXPECT_EQ(knee.from.point, Vec3(0, 0.5, -0.125));
  EXPECT_LT((knee.to.point - Vec3(0.5, 0, 0)).norm(), 1e-15);
  EXPECT_EQ(knee.from.axes, Mat3::Identity());
  EXPECT_LT((knee.to.axes.col(0) - Vec3(0, -1, 0)).norm(), 1e-15);
  EXPECT_EQ(knee.to.axes.col(2), Vec3(0, 0, 1));
}

TEST(JointCheck, bothFramesCoincideAtTheStart) {
  const Scene scene = parseScene(kJoints, "f");
  for (const Joint& joint : scene.joints) {
    if (joint.kind == Joint::Kind::kRod || joint.kind == Joint::Kind::kRope) {
      continue;
    }
    const Pose from = poseOf(scene, joint.from);
    const Pose to = poseOf(scene, joint.to);
    EXPECT_LT((joint.from.pointAt(from) - joint.to.pointAt(to)).norm(), 1e-15) << joint.name;
    EXPECT_LT((joint.from.axesAt(from) - joint.to.axesAt(to)).norm(), 1e-15) << joint.name;
    if (joint.hasCoordinate()) {
      EXPECT_NEAR(jointCoordinate(joint, from, to), 0, 1e-15) << joint.name;
    }
  }
}

// "world" is named first: its way relative to the bob's grows as the bob goes back along the axis (1, 0, 0).
TEST(JointCheck, theWorldComesSecondAndTheCoordinateStays) {
  const Scene scene = parseScene(kJoints, "f");
  const Joint& slider = scene.joints[1];
  EXPECT_EQ(slider.from.body, 2);
  EXPECT_EQ(slider.to.body, std::nullopt);
  EXPECT_EQ(slider.from.point, Vec3::Zero());
  EXPECT_EQ(slider.to.point, Vec3(1, 0.5, 4));
  EXPECT_EQ(slider.to.axes.col(2), Vec3(-1, 0, 0));
  EXPECT_EQ(slider.to.axes.determinant(), 1);
  Pose moved = scene.boxes[2].pose;
  moved.position.x() -= 0.75;
  EXPECT_EQ(jointCoordinate(slider, moved, Pose{}), 0.75);
  EXPECT_EQ(slider.lowest, 0);
  EXPECT_EQ(slider.highest, 2);
  const Joint& rope = scene.joints[5];
  EXPECT_EQ(rope.from.body, 2);
  EXPECT_EQ(rope.from.point, Vec3::Zero());
  EXPECT_EQ(rope.to.point, Vec3(1, 0.5, 6));
}

TEST(JointCheck, aFixedJointIsInTheMiddleOfTheFirstBox) {
  const Scene scene = parseScene(kJoints, "f");
  const Joint& weld = scene.joints[3];
  EXPECT_EQ(weld.from.body, 3);
  EXPECT_EQ(weld.from.point, Vec3::Zero());
  EXPECT_EQ(weld.to.point, Vec3(2, 0.5, -1.625));
  const Scene swapped =
      parseScene(sceneBut(kJoints, R"("between": ["post", "lid"])", R"("between": ["world", "lid"])"), "f");
  EXPECT_EQ(swapped.joints[3].from.body, 1);
  EXPECT_EQ(swapped.joints[3].to.point, Vec3(1, 0.5, 2.125));
}

TEST(JointCheck, aLengthThatIsNotGivenIsTheDistance) {
  EXPECT_EQ(parseScene(sceneBut(kJoints, R"(,
      "length": 1.75)",
                                ""),
                       "f")
                .joints[4]
                .length,
            1.75);
  EXPECT_EQ(parseScene(sceneBut(kJoints, R"(
      "length": 2.5,)",
                                ""),
                       "f")
                .joints[5]
                .length,
            2);
  // What rounds does not begin open.
  EXPECT_EQ(parseScene(sceneBut(kJoints, "2.5,", "1.999999999,"), "f").joints[5].length, 2);
  EXPECT_EQ(parseScene(sceneBut(kJoints, "1.75,", "1.750000001,"), "f").joints[4].length, 1.75);
}

TEST(JointCheck, joinedBoxesPassThroughEachOtherUnlessTheyCollide) {
  const Scene scene = parseScene(kJoints, "f");
  EXPECT_EQ(scene.apart, (std::vector<std::pair<int, int>>{{0, 1}, {0, 2}, {1, 2}, {1, 3}, {2, 4}}));
  const Scene collides = parseScene(sceneBut(sceneBut(kJoints, R"(["bob", "crate", "lid"], )", ""),
                                             R"("until": 1 })", R"("until": 1, "collide": true })"),
                                    "f");
  EXPECT_EQ(collides.apart, (std::vector<std::pair<int, int>>{{0, 1}, {1, 3}, {2, 4}}));
}

const std::vector<BadPiece> kBadJoints = {
    {R"(["lid", "crate"])", R"(["lid", @"crte"])", R"(found no box of the name "crte", expected "crate")"},
    {R"(["lid", "crate"])", R"(@["lid", "lid"])",
     "found a joint from a box to itself, expected two ends that can move apart"},
    {R"(["lid", "crate"])", R"(@["world", "world"])",
     "found a joint from the world to the world, expected two ends that can move apart"},
    {R"(["post", "lid"])", R"(@["post", "rock"])",
     "found a joint whose ends cannot move, expected a box that is not fixed"},
    {R"(["post", "lid"])", R"(@["world", "rock"])",
     "found a joint whose ends cannot move, expected a box that is not fixed"},
    {"[-0.5, 2.25]", "@[0.5, 2.25]",
     "found [0.5, 2.25] for joints[0].range, expected a range with 0 in it, where the joint starts"},
    {"[-0.5, 2.25]", "@[2.25, -0.5]",
     "found [2.25, -0.5] for joints[0].range, expected its lowest value first, and a higher one"},
    {"[-0.5, 2.25]", "@[0, 0]",
     "found [0, 0] for joints[0].range, expected its lowest value first, and a higher one"},
    {"[-0.5, 2.25]", "@[-3.1416, 3.1416]",
     "found [-3.142, 3.142] for joints[0].range, expected less than a turn, 2π rad"},
    {R"("length": 1.75)", R"("length": @1.5)",
     "found 1.5 for joints[4].length, which its points exceed by 0.25 m at the start, expected their "
     "distance, "
     "1.75 m"},
    {R"("length": 1.75)", R"("length": @1.75000001)",
     "found 1.75000001 for joints[4].length, which its points exceed by -1e-08 m at the start, expected "
     "their "
     "distance, 1.75 m"},
    {R"("length": 2.5)", R"("length": @1.9375)",
     "found 1.9375 for joints[5].length, which its points exceed by 0.0625 m at the start, expected at least "
     "their distance, 2 m"},
    {R"("points": [[1, 0.5, 6], [0, 0, 0]],
      "length": 2.5)",
     R"("points": @[[1, 0.5, 4], [0, 0, 0]])",
     "found one place for both points of joints[5] at the start, expected two places, or a rope with a "
     "length"},
    {R"("weld")", R"(@"knee")",
     R"(found "knee" for joints[3], expected another name: joints[0] has this one)"},
    {R"("weld")", R"(@"joint-2")",
     R"(found "joint-2" for joints[3], expected another name: joints[2] has this one)"},
    {R"("rock", "bob"])", R"("rock", @"bo"])", R"(found no box of the name "bo", expected "bob")"},
    {R"("rock", "bob"])", R"("rock", "bob", @"rock"])",
     R"(found box "rock" twice in one list, expected each box once)"},
    {R"([1, 0.1]])", R"([@0, 0.1]])",
     "found 0 for control.motors[1].target.path[1][0], expected a time after that of the point before"},
    {R"("joint": "joint-1", "target")", R"("joint": @"elbow", "target")",
     R"(found unknown joint "elbow", expected the name of a joint)"},
    {R"("joint": "joint-1", "target")", R"("joint": @"weld", "target")",
     R"(found joint "weld", which has no coordinate, expected a hinge or slider)"},
    {R"("knee": [-3, 1])", R"(@"stick": [-3, 1])",
     R"(found joint "stick", which has no coordinate, expected a hinge or slider)"},
    {R"("period": 0.125)", R"("period": @1e-9)",
     "found 1e-9 for control.period, more than a million samples, expected a longer period, or a shorter "
     "scene"},
};

TEST(JointCheck, badJointsAreToldWhereAndWhy) {
  for (const BadPiece& bad : kBadJoints) {
    const MarkedText marked(sceneBut(kJoints, bad.piece, bad.instead));
    EXPECT_EQ(inputErrorOf([&] { parseScene(marked.text, "f"); }), "f:" + marked.place + ": " + bad.message);
  }
}

// The lid begins half a radian further than the crate's frame; the bob 0.5 m further back, as the world is
// named first.
TEST(JointCheck, aJointMayBeginAnywhereInItsRange) {
  const Scene turned = parseScene(sceneBut(kJoints, R"("start": 0)", R"("start": 0.5)"), "f");
  EXPECT_NEAR(jointCoordinate(turned.joints[0], turned.boxes[1].pose, turned.boxes[0].pose), 0.5, 1e-15);
  const Scene moved =
      parseScene(sceneBut(kJoints, R"("range": [0, 2],)", R"("range": [0, 2], "start": 0.5,)"), "f");
  EXPECT_NEAR(jointCoordinate(moved.joints[1], moved.boxes[2].pose, {}), 0.5, 1e-15);
  const MarkedText turning(sceneBut(kJoints, R"("start": 0)", R"("start": @-1e60)"));
  EXPECT_EQ(
      inputErrorOf([&] { parseScene(turning.text, "f"); }),
      "f:" + turning.place + ": found -1e+60 rad for joints[0].start, expected less than a million turns");
  const MarkedText outside(
      sceneBut(kJoints, R"("range": [-0.5, 2.25], "start": 0)", R"("range": @[-0.5, 2.25], "start": 3)"));
  EXPECT_EQ(inputErrorOf([&] { parseScene(outside.text, "f"); }),
            "f:" + outside.place +
                ": found [-0.5, 2.25] for joints[0].range, expected a range with 3 in it, where the joint "
                "starts");
}

TEST(JointCheck, motorsFindTheirJoints) {
  const Scene scene = parseScene(kJoints, "f");
  ASSERT_TRUE(scene.control);
  ASSERT_EQ(scene.control->motors.size(), 3U);
  EXPECT_EQ(scene.control->motors[0].joint, 0);
  EXPECT_EQ(scene.control->motors[1].joint, 1);
  EXPECT_EQ(scene.control->motors[1].gains[0].joint, 0);
  EXPECT_EQ(scene.control->motors[1].gains[1].joint, 1);
}

TEST(JointCheck, aBoxNamedWorldCannotBeToldFromTheWorld) {
  const std::string renamed = sceneBut(kJoints, R"("name": "rock")", R"("name": "world")");
  const MarkedText marked(sceneBut(sceneBut(renamed, R"(["rock", "bob"])", R"(["post", "bob"])"),
                                   R"(["world", "bob"], "at")", R"([@"world", "bob"], "at")"));
  EXPECT_EQ(inputErrorOf([&] { parseScene(marked.text, "f"); }),
            "f:" + marked.place +
                R"(: found "world", which is the name of a box too, expected another name for that box)");
}

}  // namespace
}  // namespace careen
