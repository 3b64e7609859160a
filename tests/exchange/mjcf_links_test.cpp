#include "exchange/mjcf_links.h"

#include <gtest/gtest.h>

#include "support/input_error.h"

namespace careen {
namespace {

const std::string kLinkedBox = R"(<geom type="box" size="0.1 0.1 0.1"/>)";
const std::string kLinkedBodies = R"(<worldbody><body name="post" pos="9 0 0">)" + kLinkedBox + R"(</body>
  <body name="a" pos="1 0 0"><joint name="hinge" axis="0 0 1"/>)" +
                                  kLinkedBox + R"(</body>
  <body name="b" pos="2 0 0"><joint name="ball" type="ball"/>)" +
                                  kLinkedBox + "</body></worldbody>";

MjcfLinks linksOf(const std::string& elements) {
  MjcfDocument document("<mujoco>" + kLinkedBodies + elements + "</mujoco>", "m.xml");
  MjcfModel model = readModel(document);
  return readLinks(document, model);
}
std::string refusalOfLinks(const std::string& elements) {
  return inputErrorOf([&] { linksOf(elements); });
}
std::string equality(const std::string& element) { return "<equality>" + element + "</equality>"; }
std::string actuator(const std::string& element) { return "<actuator>" + element + "</actuator>"; }
const std::string kTurned = R"(<keyframe><key name="start" qpos="1.5 1 0 0 0"/></keyframe>)";

TEST(MjcfLinks, whatHoldsAtTheStartClosesLoops) {
  const MjcfLinks links =
      linksOf(equality(R"(<connect name="c" body1="a" body2="b" anchor="0.5 0 0" solref="0.1 1"/>
      <weld body1="world" body2="b"/><connect body1="post" body2="a" anchor="-8 0 1"/>
      <weld body1="a" active="false"/><connect body1="post" anchor="0 0 0"/>)"));
  ASSERT_EQ(links.closings.size(), 3U);
  EXPECT_EQ(links.closings[0].name, "c");
  EXPECT_FALSE(links.closings[0].isFixed);
  EXPECT_EQ(links.closings[0].from, 1U);
  EXPECT_EQ(links.closings[0].to, 2U);
  EXPECT_LT((links.closings[0].at - Vec3(1.5, 0, 0)).norm(), 1e-15);
  EXPECT_TRUE(links.closings[1].isFixed);
  EXPECT_EQ(links.closings[1].from, 2U);
  EXPECT_FALSE(links.closings[1].to);
  EXPECT_EQ(links.closings[2].from, 1U);
  EXPECT_EQ(links.closings[2].to, 0U);
  EXPECT_LT((links.closings[2].at - Vec3(1, 0, 1)).norm(), 1e-15);
}

TEST(MjcfLinks, whatDoesNotHoldOrIsNoneIsRefused) {
  EXPECT_NE(refusalOfLinks(equality(R"(<connect body1="a" anchor="0.5 0 0"/>)") + kTurned)
                .find("found <connect> that the key frame \"start\" leaves open"),
            std::string::npos);
  EXPECT_EQ(refusalOfLinks(equality(R"(<connect body1="a" anchor="0 0 0.5"/>)") + kTurned), "no error")
      << "on the axis";
  EXPECT_NE(
      refusalOfLinks(equality(R"(<weld body1="a"/>)") + kTurned).find("found <weld> that the key frame"),
      std::string::npos);
  EXPECT_EQ(refusalOfLinks("\n" + equality(R"(<weld body1="a" body2="no"/>)")).substr(0, 36),
            "m.xml:4:27: found body2=\"no\" for <we");
  EXPECT_NE(refusalOfLinks(equality(R"(<weld body1="a" body2="a"/>)")).find("found <weld> of one body"),
            std::string::npos);
  EXPECT_NE(refusalOfLinks(equality(R"(<weld body1="a" relpose="0 0 0 1 0 0 0"/>)")).find("found relpose="),
            std::string::npos);
  EXPECT_NE(refusalOfLinks(equality(R"(<joint joint1="hinge"/>)")).find("found <joint> in <equality>"),
            std::string::npos);
  EXPECT_NE(refusalOfLinks(equality(R"(<tendon tendon1="no"/>)")).find("found \"no\" for tendon1"),
            std::string::npos);
}

TEST(MjcfLinks, actuatorsOfHingesFollowTheirControls) {
  const MjcfLinks links = linksOf(
      actuator(R"(<motor joint="hinge" gear="3" ctrlrange="-1 1"/><position joint="hinge" ctrlrange="-1 1"/>
      <velocity joint="hinge" kv="2" gear="-3" forcerange="-4 4"/>)") +
      R"(<option timestep="0.25"/><keyframe><key name="start" ctrl="0 7 0"/></keyframe>)");
  ASSERT_EQ(links.motors.size(), 2U);
  EXPECT_EQ(links.motors[0].surface, 1U);
  EXPECT_EQ(links.motors[0].kp, 1);
  EXPECT_EQ(links.motors[0].kd, 0);
  EXPECT_EQ(links.motors[0].target, 1) << "the nearest in its range";
  EXPECT_EQ(links.motors[0].largest, 0);
  EXPECT_EQ(links.motors[1].kp, 0);
  EXPECT_EQ(links.motors[1].kd, 18);
  EXPECT_EQ(links.motors[1].largest, 12);
  EXPECT_EQ(links.timestep, 0.25);
}

TEST(MjcfLinks, otherActuatorsAreRefused) {
  EXPECT_NE(refusalOfLinks(actuator(R"(<position joint="ball"/>)")).find("found \"ball\" for joint"),
            std::string::npos);
  EXPECT_NE(refusalOfLinks(actuator(R"(<general joint="hinge"/>)")).find("found <general> in <actuator>"),
            std::string::npos);
  EXPECT_NE(refusalOfLinks(actuator(R"(<motor tendon="t"/>)")).find("found tendon=\"t\" for <motor>"),
            std::string::npos);
  EXPECT_NE(refusalOfLinks(actuator(R"(<position joint="hinge" forcerange="-1 2"/>)"))
                .find("found forcerange=\"-1 2\""),
            std::string::npos);
  EXPECT_NE(refusalOfLinks(actuator(R"(<motor joint="hinge"/>)") +
                           R"(<keyframe><key name="start" ctrl="1"/></keyframe>)")
                .find("found <motor> with a control that is not 0"),
            std::string::npos);
  EXPECT_NE(refusalOfLinks(actuator(R"(<motor joint="hinge"/>)") + "<default><motor gear=\"2\"/></default>")
                .find("found <motor> in <default>"),
            std::string::npos);
}

}  // namespace
}  // namespace careen
