#include "exchange/mjcf_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/input_error.h"

namespace careen {
namespace {

MjcfModel modelOf(const std::string& elements) {
  MjcfDocument document("<mujoco>" + elements + "</mujoco>", "m.xml");
  return readModel(document);
}

TEST(MjcfModel, fixedBodiesAreOneInAnother) {
  const MjcfModel model = modelOf(R"(<worldbody><body pos="1 0 0" euler="0 0 90" name="arm">
      <geom type="box" size="1 1 1" pos="1 0 0"/>
      <body pos="0 2 0" euler="0 90 0"><geom type="plane" name="floor" pos="0 0 1"/></body></body>
      <geom type="box" size="2 2 2"/></worldbody>)");
  ASSERT_EQ(model.surfaces.size(), 3U);
  EXPECT_LT((model.surfaces[0].frame.position - Vec3(1, 1, 0)).norm(), 1e-15);
  EXPECT_EQ(model.surfaces[0].name, "arm");
  // At (0, 2, 0) of the arm, which is (−1, 0, 0); its z is the arm's x, the world's y.
  EXPECT_TRUE(model.surfaces[1].isPlane());
  EXPECT_LT((model.surfaces[1].frame.position - Vec3(-1, 1, 0)).norm(), 1e-15);
  EXPECT_LT((model.surfaces[1].frame.turn * Vec3::UnitZ() - Vec3::UnitY()).norm(), 1e-15);
  EXPECT_EQ(model.surfaces[2].name, "box-2");
}

const std::string kTwo = R"(<worldbody><site name="ceiling" pos="0 0 5"/>
  <body name="a" pos="0 0 1"><joint type="free" damping="0.5"/><geom type="box" size="1 1 1" pos="1 0 0" euler="0 0 90"/>
    <site name="on a" pos="1 1 0"/></body>
  <body name="b" pos="9 0 1"><freejoint/><geom type="box" size="1 1 1"/><site name="on b"/></body></worldbody>)";

TEST(MjcfModel, sitesAreInTheAxesOfTheirBox) {
  const MjcfModel model = modelOf(kTwo + R"(<tendon><spatial stiffness="3" damping="0.25" springlength="2">
      <site site="on a"/><site site="ceiling"/></spatial>
      <spatial stiffness="1"><site site="on a"/><site site="on b"/></spatial></tendon>)");
  ASSERT_EQ(model.springs.size(), 2U);
  const MjcfSpring& spring = model.springs[0];
  EXPECT_EQ(spring.from.surface, 0U);
  EXPECT_LT((spring.from.point - Vec3(1, 0, 0)).norm(), 1e-15);  // y of the body is x of the box
  EXPECT_FALSE(spring.to.surface);
  EXPECT_EQ(spring.to.point, Vec3(0, 0, 5));
  EXPECT_EQ(spring.stiffness, 3);
  EXPECT_EQ(spring.damping, 0.25);
  EXPECT_EQ(spring.restLength, 2);
  EXPECT_NEAR(model.springs[1].restLength, std::sqrt(65), 1e-14) << "as the model stands";
  EXPECT_EQ(model.surfaces[0].joint.damping, 0.5);
  EXPECT_EQ(model.surfaces[1].joint.damping, 0);
}

TEST(MjcfModel, aKeyFrameMovesBodiesNotTheirSprings) {
  const MjcfModel model = modelOf(kTwo + R"(<keyframe><key name="start" qpos="0 0 0 1 0 0 0  5 5 5 0 0 0 2"
      qvel="1 2 3 0 0 4  0 0 0 1 0 0"/></keyframe><tendon><spatial><site site="on a"/><site site="on b"/></spatial></tendon>)");
  EXPECT_EQ(model.surfaces[0].frame.position, Vec3(1, 0, 0));
  EXPECT_EQ(model.surfaces[0].velocity, Vec3(1, 6, 3)) << "of the box, 1 m from the body's origin";
  EXPECT_EQ(model.surfaces[1].frame.position, Vec3(5, 5, 5));
  EXPECT_LT((model.surfaces[1].frame.turn * Vec3::UnitX() + Vec3::UnitX()).norm(), 1e-15);
  EXPECT_LT((model.surfaces[1].angularVelocity + Vec3::UnitX()).norm(), 1e-15) << "half a turn about z";
  EXPECT_NEAR(model.springs[0].restLength, std::sqrt(65), 1e-14);
}

TEST(MjcfModel, namesAreWithoutDoubles) {
  const std::string plane = R"(<geom name="a" type="plane"/>)";
  const std::string box = R"(<body name="a"><freejoint/><geom type="box" size="1 1 1"/></body>)";
  const MjcfModel model = modelOf("<worldbody>" + plane + box + "</worldbody>");
  EXPECT_EQ(model.surfaces[1].name, "a-2");
  EXPECT_EQ(model.notes, (std::vector<std::string>{R"(renamed: "a" is "a-2")"}));
}

TEST(MjcfModel, aTendonJoinsTwoBodies) {
  const auto refusal = [](const std::string& sites) {
    return inputErrorOf([&] { modelOf(kTwo + "<tendon><spatial>" + sites + "</spatial></tendon>"); });
  };
  EXPECT_NE(refusal(R"(<site site="on a"/>)").find("found 1 sites of a tendon"), std::string::npos);
  EXPECT_NE(refusal(R"(<site site="ceiling"/><site site="ceiling"/>)").find("found 2 sites of a tendon"),
            std::string::npos);
  EXPECT_NE(refusal(R"(<site site="nowhere"/>)").find("found <site> in <spatial>"), std::string::npos);
  EXPECT_NE(refusal("<pulley/>").find("found <pulley> in <spatial>"), std::string::npos);
}

}  // namespace
}  // namespace careen
