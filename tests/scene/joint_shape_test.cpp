#include "scene/joint_shape.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scene/scene_shape.h"
#include "support/input_error.h"
#include "support/scenes.h"

namespace careen {
namespace {

std::string shapeErrorOfJoints(const std::string& text) {
  return inputErrorOf([&text] { readShape(JsonTree(text, "f")); });
}

TEST(JointShape, readsEveryKey) {
  const std::vector<Joint> joints = readShape(JsonTree(kJoints, "f")).joints;
  ASSERT_EQ(joints.size(), kJointKindNames.size());
  const Joint& knee = joints[0];
  EXPECT_EQ(knee.name, "knee");
  EXPECT_EQ(knee.kind, Joint::Kind::kHinge);
  EXPECT_EQ(knee.from.point, Vec3(1, 1, 2));
  EXPECT_EQ(knee.from.axes, Mat3::Identity());  // about z, of any length
  EXPECT_EQ(knee.to.axes, Mat3::Identity());
  EXPECT_EQ(knee.lowest, -0.5);
  EXPECT_EQ(knee.highest, 2.25);
  EXPECT_EQ(knee.restitution, 0.5);
  EXPECT_EQ(knee.until, Joint::kFree);
  EXPECT_EQ(knee.grip, 1.25);
  EXPECT_EQ(knee.keptRate, 0);
  const Joint& slider = joints[1];
  EXPECT_EQ(slider.name, "joint-1");
  EXPECT_EQ(slider.from.axes.col(2), Vec3(1, 0, 0));
  EXPECT_EQ(slider.until, 1.5);
  EXPECT_EQ(slider.grip, 45);
  EXPECT_EQ(slider.keptRate, -0.375);
  const Joint& rope = joints[5];
  EXPECT_EQ(rope.from.point, Vec3(1, 0.5, 6));
  EXPECT_EQ(rope.to.point, Vec3::Zero());
  EXPECT_EQ(rope.length, 2.5);
  EXPECT_EQ(rope.restitution, 0.25);
  EXPECT_EQ(joints[3].lowest, -Joint::kFree);
}

// Right-handed and orthonormal, with the axis as z, whatever the axis.
TEST(JointShape, framesAreAboutTheAxis) {
  for (const char* axis : {"[1, 2, 3]", "[0, -3, 4]", "[-1e-3, 0, 1e-3]", "[5, 5, 5]", "[0, 1, 1e-200]"}) {
    const Scene scene = readShape(
        JsonTree(sceneBut(kJoints, R"("axis": [0, 0, 2])", R"("axis": )" + std::string(axis)), "f"));
    const Mat3& frame = scene.joints[0].from.axes;
    const JsonTree given(axis, "f");
    EXPECT_LT((frame.col(2) - JsonValue(given, given.root(), "").direction()).norm(), 1e-16);
    EXPECT_LT((frame.transpose() * frame - Mat3::Identity()).norm(), 1e-15) << axis;
    EXPECT_NEAR(frame.determinant(), 1, 1e-15) << axis;
  }
}

const std::vector<BadPiece> kBadShapes = {
    {R"("hinge")", R"(@"hing")",
     R"(found the unknown type of joint "hing", expected one of ball, hinge, slider, fixed, rod, rope)"},
    {R"("type": "hinge", )", "", ""},
    {R"(["lid", "crate"])", R"(@["lid"])",
     R"(found an array of 1 for joints[0].between, expected [name, name] of two boxes, or of one and "world")"},
    {R"(["lid", "crate"])", R"(["lid", @3])",
     R"(found 3 for joints[0].between[1], expected the name of a box, or "world")"},
    {R"("axis": [0, 0, 2])", R"("axis": @[0, 0, 0])",
     "found a zero vector for joints[0].axis, expected a direction"},
    {R"("at": [2, 1, 3])", R"("at": [2, 1, 3], "axis": @[0, 0, 1])",
     "found an array of 3 for joints[2].axis, expected none: a joint of type ball has no axis"},
    {R"("at": [2, 1, 3])", R"("at": [2, 1, 3], "restitution": @0)",
     "found 0 for joints[2].restitution, expected none: a joint of type ball has no restitution"},
    {R"(["post", "lid"])", R"(["post", "lid"], "range": @[0, 1])",
     "found an array of 2 for joints[3].range, expected none: a joint of type fixed has no range"},
    {R"("axis": [0, 0, 2])", R"("axis": [0, 0, 2], "length": @1)",
     "found 1 for joints[0].length, expected none: a joint of type hinge has no length"},
    {R"("length": 1.75)", R"("at": @[0, 0, 0])",
     "found an array of 3 for joints[4].at, expected none: a joint of type rod has no at"},
    {R"("length": 1.75)", R"("length": @0)", "found 0 for joints[4].length, expected a number above 0 [m]"},
    {R"("until": 1.5)", R"("until": @0)", "found 0 for joints[1].until, expected a number above 0 [s]"},
    {R"("restitution": 0.5)", R"("restitution": @1.5)",
     "found 1.5 for joints[0].restitution, expected a number from 0 to 1"},
    {"[-0.5, 2.25]", "[-0.5, @null]", "found null for joints[0].range[1], expected a number [rad]"},
    {R"("friction": 1.25)", R"("friction": @-1)",
     "found -1 for joints[0].friction, expected a number not below 0 [N m]"},
    {R"("friction": 1.25)", R"("friction": 1, "drive": @{ "speed": 1, "max": 2 })",
     "found an object for joints[0].drive, expected none beside friction: both are one law, and friction "
     "that of "
     "speed 0"},
    {R"({ "speed": -0.375, "max": 45 })", R"({ "speed": 1, "max": @-2 })",
     "found -2 for joints[1].drive.max, expected a number not below 0 [N]"},
    {R"({ "speed": -0.375, "max": 45 })", R"({ "speed": @"x", "max": 2 })",
     "found \"x\" for joints[1].drive.speed, expected a number [m/s]"},
    {R"({ "speed": -0.375, "max": 45 })", R"(@{ "max": 2 })",
     "found no speed in joints[1].drive, expected that key"},
    {R"("at": [2, 1, 3])", R"("at": [2, 1, 3], "friction": @0)",
     "found 0 for joints[2].friction, expected none: a joint of type ball has no friction"},
    {R"("length": 1.75)", R"("drive": @{})",
     "found an object for joints[4].drive, expected none: a joint of type rod has no drive"},
    {R"("collide": false)", R"("collide": @0)", "found 0 for joints[0].collide, expected true or false"},
    {R"(["rock", "bob"])", R"(@["rock"])",
     "found an array of 1 for pass_through[1], expected two names of boxes or more"},
};

TEST(JointShape, badValuesAreToldWhereAndWhy) {
  for (const BadPiece& bad : kBadShapes) {
    if (bad.message.empty()) {
      EXPECT_NE(
          shapeErrorOfJoints(sceneBut(kJoints, bad.piece, bad.instead)).find("found no type in joints[0]"),
          std::string::npos);
      continue;
    }
    const MarkedText marked(sceneBut(kJoints, bad.piece, bad.instead));
    EXPECT_EQ(shapeErrorOfJoints(marked.text), "f:" + marked.place + ": " + bad.message);
  }
}

}  // namespace
}  // namespace careen
