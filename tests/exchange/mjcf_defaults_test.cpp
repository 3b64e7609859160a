#include "exchange/mjcf_defaults.h"

#include <gtest/gtest.h>

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

TEST(MjcfDefaults, onlyFreeJointsWithoutForces) {
  const auto joint = [](const std::string& element, const std::string& ofBody) {
    const Read read("<body>" + element + "</body>");
    return read.defaults.joint(read.document.sections("body")[0]->children[0], ofBody);
  };
  EXPECT_TRUE(joint("<freejoint/>", "light").isFree);
  EXPECT_EQ(joint("<freejoint/>", "light").damping, 0) << "takes no defaults";
  EXPECT_EQ(joint("<joint/>", "light").damping, 2);
  EXPECT_FALSE(joint("<joint/>", "main").isFree);
  EXPECT_EQ(joint("<joint type='slide'/>", "light").type, "slide");
  EXPECT_NE(inputErrorOf([&] {
              joint("<joint stiffness='1'/>", "light");
            }).find("found stiffness=\"1\" for <joint>"),
            std::string::npos);
}

TEST(MjcfDefaults, refusesClassesThatAreNotThere) {
  EXPECT_EQ(inputErrorOf([] { Read("\n<geom class='heavy'/>").geom(); }),
            "m.xml:7:7: found class=\"heavy\" for <geom>, expected a class of <default>");
}

}  // namespace
}  // namespace careen
