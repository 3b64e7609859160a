#include "scene/motion_shape.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scene/scene_reader.h"
#include "support/input_error.h"

namespace careen {
namespace {

std::string sceneOf(const std::string& box) {
  return R"({ "careen": 1, "duration": 1, "boxes": [ { "half_extents": [1, 1, 1], )" + box + " } ] }";
}

Course courseOfScene(const std::string& box) { return parseScene(sceneOf(box), "f").boxes[0].course; }

TEST(MotionShape, readsAPath) {
  const Scene scene =
      parseScene(sceneOf(R"("fixed": true, "motion": { "path": [[0.25, 1, 2, 3], [0.5, 1, 2, 4]] })"), "f");
  ASSERT_EQ(scene.boxes[0].course.size(), 3U);
  EXPECT_EQ(scene.boxes[0].pose.position, Vec3(1, 2, 3));
  EXPECT_EQ(scene.boxes[0].course[1].from, 0.25);
  EXPECT_EQ(scene.boxes[0].course[1].motion.velocity, Vec3(0, 0, 4));
}

TEST(MotionShape, readsWhatAddsUp) {
  const Course course = courseOfScene(R"("fixed": true, "position": [1, 0, 0], "motion": {
      "velocity": [0, 1, 0], "angular_velocity": [0, 0, 2], "about": [0, 0, 0],
      "oscillation": { "amplitude": [0, 0, 3], "angular_amplitude": [0, 0, 0.5], "frequency": 0.5, "phase": 1 } })");
  ASSERT_EQ(course.size(), 1U);
  const Driven& motion = course[0].motion;
  EXPECT_EQ(motion.pivot, Vec3::Zero());
  EXPECT_EQ(motion.arm, Vec3(1, 0, 0));
  EXPECT_EQ(motion.velocity, Vec3(0, 1, 0));
  EXPECT_EQ(motion.spin, Vec3(0, 0, 2));
  EXPECT_EQ(motion.amplitude, Vec3(0, 0, 3));
  EXPECT_EQ(motion.swing, Vec3(0, 0, 0.5));
  EXPECT_DOUBLE_EQ(motion.rate, 3.14159265358979324);
  EXPECT_EQ(motion.phase, 1);
}

// The box is where its oscillation begins.
TEST(MotionShape, beginsAtItsPhase) {
  const Scene scene = parseScene(sceneOf(R"("fixed": true, "motion": {
      "oscillation": { "amplitude": [2, 0, 0], "frequency": 1, "phase": 1.57079632679489662 } })"),
                                 "f");
  EXPECT_LT((scene.boxes[0].pose.position - Vec3(2, 0, 0)).norm(), 1e-15);
}

TEST(MotionShape, refusesWhatIsNone) {
  struct Bad {
    std::string box;
    std::string error;
  };
  const std::vector<Bad> all = {
      {R"("mass": 1, "motion": { "velocity": [1, 0, 0] })",
       R"(found motion for box "box-0", which is not fixed)"},
      {R"("fixed": true, "motion": {})", "found no motion for boxes[0].motion"},
      {R"("fixed": true, "motion": { "path": [] })", "expected one point or more"},
      {R"("fixed": true, "motion": { "path": [[1, 0, 0, 0], [1, 0, 0, 1]] })",
       "expected a time after that of the point before"},
      {R"("fixed": true, "position": [0, 0, 1], "motion": { "path": [[1, 0, 0, 0]] })",
       "expected none, as the motion's path tells it, or that of its first point"},
      {R"("fixed": true, "motion": { "oscillation": { "frequency": 1 } })", "expected one of them, or both"},
      {R"("fixed": true, "motion": { "oscillation": { "amplitude": [1, 0, 0], "frequency": 0 } })",
       "expected a number above 0, up to 1e6"},
      {R"("fixed": true, "motion": { "about": [0, 0, 0], "velocity": [1, 0, 0] })",
       "expected an angular_velocity or angular_amplitude too"},
      {R"("fixed": true, "motion": { "angular_velocity": [1, 0, 0],
          "oscillation": { "angular_amplitude": [0, 1, 0], "frequency": 1 } })",
       "expected one axis for both"},
      {R"("fixed": true, "surface_velocity": [1, 0, 0], "motion": { "velocity": [1, 0, 0] })",
       R"(found surface_velocity for box "box-0", which has a motion)"}};
  for (const Bad& bad : all) {
    const std::string error = inputErrorOf([&] { parseScene(sceneOf(bad.box), "f"); });
    EXPECT_NE(error.find(bad.error), std::string::npos) << error;
    EXPECT_EQ(error.rfind("f:", 0), 0U) << error;  // with its line and column
  }
}

std::string sceneOfWall(const std::string& wall) {
  return R"({ "careen": 1, "duration": 1, "boxes": [ { "half_extents": [1, 1, 1], "mass": 1, "position": [0, 0, 9] } ],
              "walls": [ { "normal": [0, 0, 2], )" +
         wall + " } ] }";
}

// Its frame has its origin at the point.
TEST(MotionShape, isOfWallsToo) {
  const Wall turning =
      parseScene(sceneOfWall(R"("point": [1, 2, 3], "motion": { "angular_velocity": [0, 1, 0] })"), "f")
          .walls[0];
  EXPECT_EQ(turning.offset, 3);
  EXPECT_EQ(planeAt(turning, 0).normal, Vec3::UnitZ());
  const WallPlane turned = planeAt(turning, 1.57079632679489662);
  EXPECT_LT((turned.normal - Vec3::UnitX()).norm(), 1e-15);
  EXPECT_NEAR(turned.offset, 1, 1e-15);
  const Scene going =
      parseScene(sceneOfWall(R"("motion": { "path": [[0.25, 1, 2, 3], [0.5, 1, 2, 4]] })"), "f");
  EXPECT_EQ(planeAt(going.walls[0], 0).offset, 3);
  EXPECT_EQ(planeAt(going.walls[0], 0.375).offset, 3.5);
  EXPECT_EQ(planeAt(going.walls[0], 2).offset, 4);
}

TEST(MotionShape, refusesWhatIsNoneOfAWall) {
  struct Bad {
    std::string wall;
    std::string error;
  };
  const std::vector<Bad> all = {
      {R"("motion": { "velocity": [1, 0, 0] })", "found no point in walls[0]"},
      {R"("point": [0, 0, 0], "motion": {})", "found no motion for walls[0].motion"},
      {R"("point": [0, 0, 1], "motion": { "path": [[1, 0, 0, 0]] })",
       "expected none, as the motion's path tells it, or that of its first point"},
      {R"("point": [0, 0, 0], "motion": { "path": [[1, 0, 0, 0], [1, 0, 0, 1]] })",
       "for walls[0].motion.path[1][0], expected a time after that of the point before"},
      {R"("point": [0, 0, 0], "surface_spin": 1, "motion": { "velocity": [1, 0, 0] })",
       R"(found surface_spin for wall "wall-0", which has a motion)"},
      {R"("point": [0, 0, 0], "motion": { "angular_velocity": [1e13, 0, 0] })",
       R"(found a motion of wall "wall-0" that turns)"}};
  for (const Bad& bad : all) {
    const std::string error = inputErrorOf([&] { parseScene(sceneOfWall(bad.wall), "f"); });
    EXPECT_NE(error.find(bad.error), std::string::npos) << error;
    EXPECT_EQ(error.rfind("f:", 0), 0U) << error;
  }
}

TEST(MotionShape, nothingIsTiedToWhatMoves) {
  const std::string boxes = R"({ "careen": 1, "duration": 1, "boxes": [
      { "name": "lift", "half_extents": [1, 1, 1], "fixed": true, "motion": { "velocity": [1, 0, 0] } },
      { "name": "load", "half_extents": [1, 1, 1], "mass": 1, "position": [0, 0, 3] } ], )";
  EXPECT_NE(inputErrorOf([&] {
              parseScene(boxes + R"("springs": [ { "from": ["load", [0, 0, 0]], "to": ["lift", [0, 0, 0]],
                                                  "stiffness": 1 } ] })",
                         "f");
            }).find(R"(found a spring to box "lift", which has a motion)"),
            std::string::npos);
  EXPECT_NE(
      inputErrorOf([&] {
        parseScene(
            boxes + R"("joints": [ { "type": "ball", "between": ["load", "lift"], "at": [0, 0, 1] } ] })",
            "f");
      }).find(R"(found a joint to box "lift", which has a motion)"),
      std::string::npos);
}

}  // namespace
}  // namespace careen
