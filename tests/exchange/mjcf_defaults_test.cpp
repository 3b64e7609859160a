#include "exchange/mjcf_defaults.h"

#include <gtest/gtest.h>

#include <numbers>

#include "support/input_error.h"

namespace careen {
namespace {

const std::string kClasses = R"(<default>
  <geom type="box" size="1 2 3" density="5" friction="0.25 0.1"/>
  <default class="light"><geom density="0.5"/><joint type="free" damping="2"/>
    <default class="small"><geom size="0.1"/></default></default>
  <default class="red"><geom rgba="1 0 0 1"/></default></default>
  <asset><material name="blue" rgba="0 0 1 1"/></asset>)";

struct Read {
  MjcfDocument document;
  MjcfDefaults defaults;
  explicit Read(const std::string& element)
      : document("<mujoco>" + kClasses + element + "</mujoco>", "m.xml"), defaults(document) {}
  MjcfGeom geom(const std::string& ofBody = "main") const {
    return defaults.geom(*document.sections("geom")[0], ofBody);
  }
};

TEST(MjcfDefaults, classesTakeAfterThoseAboveThem) {
  const MjcfGeom plain = Read("<geom/>").geom();
  EXPECT_EQ(plain.type, "box");
  EXPECT_EQ(plain.size, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(plain.density, 5);
  EXPECT_EQ(plain.friction, 0.25);
  const MjcfGeom small = Read("<geom class='small'/>").geom("red");
  EXPECT_EQ(small.size, (std::vector<double>{0.1, 2, 3})) << "one number leaves the others";
  EXPECT_EQ(small.density, 0.5);
  EXPECT_FALSE(small.color) << "its own class counts, not its body's";
  EXPECT_EQ(Read("<geom/>").geom("small").density, 0.5);
  EXPECT_EQ(Read("<geom density='7'/>").geom("small").density, 7);
}

TEST(MjcfDefaults, ownColorsGoBeforeMaterials) {
  EXPECT_EQ(Read("<geom material='blue'/>").geom().color->at(2), 1);
  EXPECT_EQ(Read("<geom material='blue' rgba='0 1 0 1'/>").geom().color->at(1), 1);
  EXPECT_EQ(Read("<geom material='blue' rgba='0.5 0.5 0.5 1'/>").geom().color->at(2), 1) << "as in MuJoCo";
  EXPECT_FALSE(Read("<geom/>").geom().color);
}

TEST(MjcfDefaults, jointsTakeAfterTheirClasses) {
  const auto joint = [](const std::string& element, const std::string& ofBody) {
    const Read read("<body>" + element + "</body>");
    MjcfJoint found = read.defaults.joint(read.document.sections("body")[0]->children[0], ofBody);
    found.element = nullptr;
    return found;
  };
  EXPECT_TRUE(joint("<freejoint/>", "light").isFree());
  EXPECT_EQ(joint("<freejoint/>", "light").damping, 0) << "takes no defaults";
  EXPECT_EQ(joint("<joint/>", "light").damping, 2);
  EXPECT_EQ(joint("<joint/>", "main").type, "hinge");
  EXPECT_EQ(joint("<joint type='slide'/>", "light").type, "slide");
  // Degrees of hinges are angles, metres of slides are not.
  const MjcfJoint hinge = joint("<joint range='-90 180' ref='45' springref='-45' stiffness='3'/>", "main");
  EXPECT_NEAR(hinge.range[0], -0.5 * std::numbers::pi, 1e-15);
  EXPECT_NEAR(hinge.range[1], std::numbers::pi, 1e-15);
  EXPECT_NEAR(hinge.ref, 0.25 * std::numbers::pi, 1e-15);
  EXPECT_NEAR(hinge.springRef, -0.25 * std::numbers::pi, 1e-15);
  EXPECT_EQ(hinge.stiffness, 3);
  EXPECT_EQ(joint("<joint type='slide' range='-90 180'/>", "main").range[1], 180);
}

TEST(MjcfDefaults, refusesWhatJointsOfScenesDoNotHave) {
  const auto refusal = [](const std::string& element, const std::string& ofBody) {
    return inputErrorOf([&] {
      const Read read("<body>" + element + "</body>");
      read.defaults.joint(read.document.sections("body")[0]->children[0], ofBody);
    });
  };
  EXPECT_NE(
      refusal("<joint stiffness='1'/>", "light").find("found stiffness=\"1\" for a joint of type \"free\""),
      std::string::npos);
  EXPECT_NE(
      refusal("<joint armature='0.5'/>", "main").find("found armature=\"0.5\" for a joint of type \"hinge\""),
      std::string::npos);
  EXPECT_NE(refusal("<joint type='ball' frictionloss='2'/>", "main").find("found frictionloss=\"2\""),
            std::string::npos);
  EXPECT_NE(refusal("<joint type='ball' damping='2'/>", "main").find("found damping=\"2\""),
            std::string::npos);
  EXPECT_NE(refusal("<joint type='ball' range='0 30'/>", "main").find("found range=\"0 30\""),
            std::string::npos);
  EXPECT_NE(refusal("<joint springdamper='1 1'/>", "main").find("found springdamper=\"1 1\""),
            std::string::npos);
  EXPECT_NE(refusal("<joint type='screw'/>", "main").find("found type=\"screw\" for <joint>"),
            std::string::npos);
  EXPECT_EQ(refusal("<joint type='ball' limited='false' range='0 30'/>", "main"), "no error");
}

TEST(MjcfDefaults, refusesClassesThatAreNotThere) {
  EXPECT_EQ(inputErrorOf([] { Read("\n<geom class='heavy'/>").geom(); }),
            "m.xml:7:7: found class=\"heavy\" for <geom>, expected a class of <default>");
}

}  // namespace
}  // namespace careen
