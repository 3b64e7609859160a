#include "exchange/mjcf_mass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/input_error.h"

namespace careen {
namespace {

// Of a body with these geoms, the first of which is its box.
MjcfMass massFrom(const std::string& geoms, const std::string& inertial, const std::string& compiler = "") {
  MjcfDocument document("<mujoco><compiler " + compiler + "/>" + geoms + inertial + "</mujoco>", "m.xml");
  const MjcfDefaults defaults(document);
  std::vector<MjcfGeom> read;
  for (const XmlElement* const geom : document.sections("geom")) {
    read.push_back(defaults.geom(*geom, "main"));
  }
  const auto found = document.sections("inertial");
  return massOf(document, read, {.geom = read[0], .parts = {}}, found.empty() ? nullptr : found[0]);
}
const std::string kBox = R"(<geom type="box" size="0.5 1 1.5")";

TEST(MjcfMass, isOfTheBoxWithoutInertial) {
  EXPECT_EQ(massFrom(kBox + "/>", "").mass, 6000);  // 1 · 2 · 3 m³ of 1000 kg/m³
  EXPECT_FALSE(massFrom(kBox + "/>", "").inertia);
  EXPECT_EQ(massFrom(kBox + " density='2'/>", "").mass, 12);
  EXPECT_EQ(massFrom(kBox + " density='2' mass='7'/>", "").mass, 7);
}

TEST(MjcfMass, inertialGoesBeforeTheBoxUnlessToldOtherwise) {
  const std::string inertial = R"(<inertial pos="0 0 0" mass="3" diaginertia="1 1.5 2"/>)";
  EXPECT_EQ(massFrom(kBox + "/>", inertial).mass, 3);
  EXPECT_EQ(*massFrom(kBox + "/>", inertial).inertia, Mat3(Vec3(1, 1.5, 2).asDiagonal()));
  EXPECT_EQ(massFrom(kBox + "/>", inertial, "inertiafromgeom='true'").mass, 6000);
  EXPECT_NE(
      inputErrorOf([&] { massFrom(kBox + "/>", "", "inertiafromgeom='false'"); }).find("without <inertial>"),
      std::string::npos);
}

TEST(MjcfMass, turnsMomentsIntoTheAxesOfTheBox) {
  // A quarter turn about z changes x and y.
  const Vec3 turned =
      massFrom(kBox + "/>", R"(<inertial pos="0 0 0" euler="0 0 90" mass="3" diaginertia="1 1.5 2"/>)")
          .inertia->diagonal();
  EXPECT_LT((turned - Vec3(1.5, 1, 2)).norm(), 1e-15);
  const Vec3 full = massFrom(kBox + R"( euler="90 0 0"/>)",
                             R"(<inertial pos="0 0 0" mass="3" fullinertia="1 1.5 2 0 0 0"/>)")
                        .inertia->diagonal();
  EXPECT_LT((full - Vec3(1, 2, 1.5)).norm(), 1e-15);
  // Turned with the box by 45° about z, in the body's axes: [[1.25, −0.25], [−0.25, 1.25]].
  const Vec3 diagonal = massFrom(kBox + R"( euler="0 0 45"/>)",
                                 R"(<inertial pos="0 0 0" mass="3" fullinertia="1.25 1.25 2 -0.25 0 0"/>)")
                            .inertia->diagonal();
  EXPECT_LT((diagonal - Vec3(1, 1.5, 2)).norm(), 1e-15);
}

TEST(MjcfMass, keepsACentreAndAxesOfItsOwn) {
  const MjcfMass found =
      massFrom(kBox + R"( pos="1 0 0" euler="0 0 90"/>)",
               R"(<inertial pos="1.2 0 0" euler="0 0 45" mass="3" diaginertia="1 1.5 2"/>)");
  EXPECT_LT((found.center - Vec3(0, -0.2, 0)).norm(), 1e-15);
  Mat3 expected;
  expected << 1.25, 0.25, 0, 0.25, 1.25, 0, 0, 0, 2;  // turned by −45° from the box
  EXPECT_LT((*found.inertia - expected).norm(), 1e-15);
}

TEST(MjcfMass, refusesWhatABoxOfASceneCannotHave) {
  const auto refusal = [](const std::string& inertial) {
    return inputErrorOf([&] { massFrom(kBox + "/>", inertial); });
  };
  const std::string head = R"(<inertial pos="0 0 0" mass="3" )";
  EXPECT_NE(refusal(head + "/>").find("found no inertia"), std::string::npos);
  EXPECT_NE(refusal(head + R"(diaginertia="1 1 1" euler="0 0 45"/>)").find("no error"), std::string::npos);
  EXPECT_NE(refusal(head + R"(diaginertia="1 1 2.1"/>)").find("found moments 1, 1, 2.1"), std::string::npos);
  EXPECT_NE(refusal(R"(<inertial pos="0 0 99" mass="3" diaginertia="1 1 1"/>)").find("inside the box"),
            std::string::npos);
  EXPECT_NE(refusal(R"(<inertial pos="0 0 0" mass="-3" diaginertia="1 1 1"/>)").find("found mass=\"-3\""),
            std::string::npos);
  EXPECT_NE(refusal(R"(<inertial mass="3" diaginertia="1 1 1"/>)").find("without pos"), std::string::npos);
}

const std::string kVisual = R"(<geom type="box" size="0.5 1 1.5" contype="0" conaffinity="0" )";

// Two equal boxes at ±x/2 of their middle: twice the mass, and twice that of one and m x²/2 about y and z.
TEST(MjcfMass, countsEveryGeomOfItsGroups) {
  const std::string second = kVisual + R"(group="2" pos="0.25 0 0"/>)";
  const MjcfMass both = massFrom(kBox + "/>", second);
  EXPECT_EQ(both.mass, 12000);
  EXPECT_EQ(both.center, Vec3(0.125, 0, 0));
  const Vec3 one = Vec3(2000 * 3.25, 2000 * 2.5, 2000 * 1.25);  // m/3 (y² + z²), ...
  EXPECT_LT((both.inertia->diagonal() - Vec3(2 * one + Vec3(0, 187.5, 187.5))).norm(), 1e-11);
  for (const char* const without : {"inertiagrouprange='0 1'", "inertiagrouprange='3 5'"}) {
    EXPECT_NE(inputErrorOf([&] { massFrom(kBox + " group='6'/>", second, without); }).find("mass of 0 kg"),
              std::string::npos);
  }
  EXPECT_EQ(massFrom(kBox + "/>", second, "inertiagrouprange='0 1'").mass, 6000);
  EXPECT_FALSE(massFrom(kBox + "/>", second, "inertiagrouprange='0 1'").inertia);
  EXPECT_FALSE(massFrom(kBox + "/>", kVisual + "mass='0' pos='0.5 0 0'/>").inertia);
  EXPECT_FALSE(massFrom(kBox + "/>", kVisual + "density='0' pos='0.5 0 0'/>").inertia);
  // Of the group of the other alone: the box has its mass and place.
  const MjcfMass other = massFrom(kBox + "/>", second, "inertiagrouprange='2 2'");
  EXPECT_EQ(other.mass, 6000);
  EXPECT_EQ(other.center, Vec3(0.25, 0, 0));
  EXPECT_LT((other.inertia->diagonal() - one).norm(), 1e-11);
}

TEST(MjcfMass, boundsAreOfMassAndOfEachPrincipalMoment) {
  const std::string small = kBox + " mass='3'/>";  // moments 3.25, 2.5, 1.25
  EXPECT_FALSE(massFrom(small, "", "boundmass='3' boundinertia='1.25'").inertia);
  const MjcfMass heavier = massFrom(small, "", "boundmass='4'");
  EXPECT_EQ(heavier.mass, 4);
  EXPECT_LT((heavier.inertia->diagonal() - Vec3(3.25, 2.5, 1.25)).norm(), 1e-15);
  const MjcfMass stiffer = massFrom(small, "", "boundinertia='2'");
  EXPECT_EQ(stiffer.mass, 3);
  EXPECT_LT((stiffer.inertia->diagonal() - Vec3(3.25, 2.5, 2)).norm(), 1e-15);
  // [[1.25, 0.25], [0.25, 1.25]] has the moments 1 and 1.5; bounded by 1.25 they are 1.25 and 1.5.
  const std::string full = R"(<inertial pos="0 0 0" mass="3" fullinertia="1.25 1.25 2 0.25 0 0"/>)";
  Mat3 expected;
  expected << 1.375, 0.125, 0, 0.125, 1.375, 0, 0, 0, 2;
  EXPECT_LT((*massFrom(kBox + "/>", full, "boundinertia='1.25'").inertia - expected).norm(), 2e-15);
}

TEST(MjcfMass, impossibleMomentsAreBalancedIfThatIsWanted) {
  const std::string inertial = R"(<inertial pos="0 0 0" mass="3" diaginertia="1 1 4"/>)";
  EXPECT_NE(inputErrorOf([&] { massFrom(kBox + "/>", inertial); }).find("moments 1, 1, 4"),
            std::string::npos);
  EXPECT_EQ(*massFrom(kBox + "/>", inertial, "balanceinertia='true'").inertia, Mat3(2 * Mat3::Identity()));
  EXPECT_FALSE(massFrom(kBox + "/>", "", "balanceinertia='true'").inertia);
}

TEST(MjcfMass, whatVersionsTakeDifferentlyIsRefused) {
  const std::string discard = "discardvisual='true'";
  EXPECT_EQ(inputErrorOf([&] { massFrom(kBox + "/>", kVisual + "/>", discard); }).substr(0, 60),
            "m.xml:1:77: found a <geom> that collides with nothing, whose");
  EXPECT_EQ(massFrom(kBox + "/>", kVisual + "mass='0'/>", discard).mass, 6000);
}

TEST(MjcfMass, ofFixedBodiesItIsTheSum) {
  MjcfDocument document("<mujoco><compiler boundmass='2'/>" + kBox + "/>" + kVisual + "mass='7'/></mujoco>",
                        "m.xml");
  const MjcfDefaults defaults(document);
  const MjcfGeom box = defaults.geom(*document.sections("geom")[0], "main");
  const MjcfGeom visual = defaults.geom(*document.sections("geom")[1], "main");
  EXPECT_EQ(fixedMassOf(document, {box, visual}, nullptr), 6007);
  EXPECT_EQ(fixedMassOf(document, {}, nullptr), 2);
}

}  // namespace
}  // namespace careen
