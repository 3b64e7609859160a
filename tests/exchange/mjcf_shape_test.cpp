#include "exchange/mjcf_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/input_error.h"

namespace careen {
namespace {

// Of a body with these geoms, one a line.
MjcfShape shapeFrom(const std::string& geoms) {
  MjcfDocument document("<mujoco>\n" + geoms + "</mujoco>", "m.xml");
  const MjcfDefaults defaults(document);
  std::vector<MjcfGeom> read;
  for (const XmlElement* const geom : document.sections("geom")) {
    read.push_back(defaults.geom(*geom, "main"));
  }
  return shapeOf(document, document.root(), read, [](const MjcfGeom& geom) { return !geom.isVisual(); });
}
std::string shapeBox(const std::string& more) { return R"(<geom type="box" size="1 2 3" )" + more + "/>\n"; }
const std::string kOnlySeen = R"(contype="0" conaffinity="0" )";

TEST(MjcfShape, oneBoxIsWhereItIs) {
  const MjcfShape shape = shapeFrom(shapeBox(kOnlySeen) + shapeBox(R"(pos="1 0 0" euler="0 0 90")"));
  EXPECT_TRUE(shape.parts.empty());
  EXPECT_EQ(shape.geom.position, Vec3(1, 0, 0));
  EXPECT_EQ(shape.geom.size, (std::vector<double>{1, 2, 3}));
  EXPECT_NEAR(shape.geom.turn.z(), std::sqrt(0.5), 1e-15);
}

// Of the second, turned by 90° about z, the reach is 2, 1, 3 about (4, −1, 0): 6, 2, 3 from the origin.
TEST(MjcfShape, severalAreInTheBodysFrame) {
  const MjcfShape shape =
      shapeFrom(shapeBox("name=\"a\" rgba=\"1 0 0 1\"") + shapeBox(R"(pos="4 -1 0" euler="0 0 90")"));
  ASSERT_EQ(shape.parts.size(), 2U);
  EXPECT_EQ(shape.parts[1].position, Vec3(4, -1, 0));
  EXPECT_EQ(shape.geom.name, "a");
  EXPECT_EQ(shape.geom.position, Vec3(0, 0, 0));
  EXPECT_EQ(shape.geom.turn.coeffs(), Quat::Identity().coeffs());
  EXPECT_EQ((*shape.geom.color)[0], 1);
  EXPECT_NEAR(shape.geom.size[0], 6, 1e-14);
  EXPECT_NEAR(shape.geom.size[1], 2, 1e-14);
  EXPECT_EQ(shape.geom.size[2], 3);
}

TEST(MjcfShape, whatIsOnlySeenIsNoPartUnlessNothingElseIsThere) {
  EXPECT_TRUE(shapeFrom(shapeBox("") + shapeBox(kOnlySeen)).parts.empty());
  EXPECT_EQ(shapeFrom(shapeBox(kOnlySeen) + shapeBox(kOnlySeen)).parts.size(), 2U);
}

TEST(MjcfShape, geomsOfABodyTouchAlike) {
  const auto refusal = [](const std::string& second) {
    return inputErrorOf([&] { shapeFrom(shapeBox("") + second); });
  };
  const std::string all = ", expected one for all geoms of a body that collide";
  EXPECT_EQ(refusal(shapeBox("friction=\"0.5\"")),
            "m.xml:3:31: found friction 0.5 in a body that has a <geom> with 1" + all);
  EXPECT_EQ(refusal(shapeBox("condim=\"1\"")),
            "m.xml:3:31: found condim 1 in a body that has a <geom> with 3" + all);
  EXPECT_EQ(refusal(shapeBox("condim=\"6\"")), "no error") << "rolling friction is ignored";
  EXPECT_EQ(refusal(shapeBox("contype=\"3\"")),
            "m.xml:3:31: found contype 3 in a body that has a <geom> with 1" + all);
  EXPECT_EQ(refusal(shapeBox("conaffinity=\"0\"")),
            "m.xml:3:31: found conaffinity 0 in a body that has a <geom> with 1" + all);
  EXPECT_EQ(refusal(shapeBox("priority=\"1\"")),
            "m.xml:3:31: found priority 1 in a body that has a <geom> with 0" + all);
  EXPECT_EQ(refusal("<geom size=\"1\"/>"),
            "m.xml:3:2: found a <geom> of type \"sphere\", expected type=\"box\" or type=\"plane\"");
}

TEST(MjcfShape, hasAsManyBoxesAsABody) {
  std::string geoms;
  for (int i = 0; i < 256; ++i) {
    geoms += shapeBox("");
  }
  EXPECT_EQ(shapeFrom(geoms).parts.size(), 256U);
  EXPECT_EQ(inputErrorOf([&] { shapeFrom(geoms + shapeBox("")); }),
            "m.xml:258:2: found one <geom> more in a body that moves, expected at most 256 that collide");
}

TEST(MjcfShape, isOfBoxesWithASize) {
  MjcfDocument document("<mujoco>\n<geom type=\"box\" size=\"1 1\"/></mujoco>", "m.xml");
  const MjcfDefaults defaults(document);
  const MjcfGeom geom = defaults.geom(*document.sections("geom")[0], "main");
  EXPECT_EQ(inputErrorOf([&] { checkBox(document, geom); }),
            "m.xml:2:18: found 2 numbers for the size of a box, expected 3 half extents above 0 [m]");
}

}  // namespace
}  // namespace careen
