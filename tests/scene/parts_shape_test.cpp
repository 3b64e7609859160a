#include "scene/parts_shape.h"

#include <gtest/gtest.h>

#include "scene/plan.h"
#include "scene/scene_reader.h"
#include "support/input_error.h"

namespace careen {
namespace {

std::string sceneWith(const std::string& box) {
  return R"({ "careen": 1, "duration": 1, "boxes": [ {)" + box + "} ] }";
}

std::string messageOf(const std::string& box) {
  return inputErrorOf([&] { parseScene(sceneWith(box), "s", Starts::kMayOverlap); });
}

TEST(PartsShape, areReadInTheBodysFrame) {
  const Scene scene = parseScene(sceneWith(R"("mass": 3, "parts": [ { "half_extents": [0.5, 0.1, 0.1] },
                   { "half_extents": [0.1, 0.1, 0.4], "position": [0.4, 0, 0.3],
                     "orientation": { "axis": [0, 0, 1], "angle_deg": 90 } } ])"),
                                 "s", Starts::kMayOverlap);
  const std::vector<BodyPart>& parts = scene.boxes[0].parts;
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_FALSE(parts[0].turned);
  EXPECT_TRUE(parts[1].turned);
  EXPECT_EQ(parts[1].middle(), Vec3(0.4, 0, 0.3));
  EXPECT_EQ(parts[1].center, Vec3(0, -0.4, 0.3));
  EXPECT_LT((scene.boxes[0].halfExtents - Vec3(0.5, 0.1, 0.7)).norm(), 1e-15);
  EXPECT_EQ(scene.boxes[0].mass, 3);
}

// Two cubes of 1 and 8 dm³, side by side: the centre of mass lies at 8/9 of the way.
TEST(PartsShape, giveMassCentreAndInertiaOfTheirUnion) {
  const Scene scene = parseScene(sceneWith(R"("density": 1000, "position": [1, 2, 3],
                   "parts": [ { "half_extents": [0.05, 0.05, 0.05] },
                              { "half_extents": [0.1, 0.1, 0.1], "position": [0.15, 0, 0] } ])"),
                                 "s", Starts::kMayOverlap);
  EXPECT_NEAR(scene.boxes[0].mass, 9, 1e-14);
  const World world = assemble(scene, plan(scene));
  const Body& body = world.bodies[0];
  EXPECT_LT((body.initial.pose.position - Vec3(1 + 0.15 * 8 / 9, 2, 3)).norm(), 1e-15);
  EXPECT_LT((boxPose(body, body.initial.pose).position - Vec3(1, 2, 3)).norm(), 1e-15);
  // Steiner: each cube's m a²/6, and m₁ m₂ / (m₁ + m₂) d² across.
  const double own = 1 * 0.01 / 6 + 8 * 0.04 / 6;
  EXPECT_NEAR(body.mass.inertiaBody.x(), own, 1e-15);
  EXPECT_NEAR(body.mass.inertiaBody.y(), own + 8.0 / 9 * 0.15 * 0.15, 1e-15);
  EXPECT_LT((partPose(body, 1, boxPose(body, body.initial.pose)).position - Vec3(1.15, 2, 3)).norm(), 1e-15);
}

TEST(PartsShape, canBeGivenAnotherCentreAndInertia) {
  const Scene scene = parseScene(sceneWith(R"("mass": 2, "center": [0, 0, 0.1], "inertia": [1, 1, 1],
                   "parts": [ { "half_extents": [0.5, 0.5, 0.2] } ])"),
                                 "s", Starts::kMayOverlap);
  EXPECT_EQ(scene.boxes[0].center, Vec3(0, 0, 0.1));
  EXPECT_EQ(*scene.boxes[0].inertia, Mat3::Identity());
}

TEST(PartsShape, refuseWhatTheyAreNot) {
  EXPECT_EQ(messageOf(R"("mass": 1, "parts": [])"),
            "s:1:63: found an array of 0 for boxes[0].parts, expected an array of 1 to 256 boxes");
  EXPECT_NE(messageOf(R"("mass": 1, "parts": [{ "half_extents": [1, 0, 1] }])")
                .find("boxes[0].parts[0].half_extents[1]"),
            std::string::npos);
  EXPECT_NE(messageOf(R"("mass": 1, "half_extents": [1, 1, 1], "parts": [{ "half_extents": [1, 1, 1] }])")
                .find("found both half_extents and parts"),
            std::string::npos);
  EXPECT_NE(messageOf(R"("mass": 1, "parts": [{ "half_extents": [1, 1, 1], "mass": 3 }])")
                .find("unknown key \"mass\""),
            std::string::npos);
  EXPECT_NE(messageOf(R"("mass": 1, "parts": [{ "half_extents": [1, 1, 1], "orientation": [0, 0, 0, 0] }])")
                .find("zero quaternion"),
            std::string::npos);
  EXPECT_NE(messageOf(R"("mass": 1)").find("half_extents"), std::string::npos);
}

}  // namespace
}  // namespace careen
