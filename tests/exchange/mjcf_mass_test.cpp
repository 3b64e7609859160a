#include "exchange/mjcf_mass.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/input_error.h"

namespace careen {
namespace {

MjcfMass massFrom(const std::string& geom, const std::string& inertial, const std::string& compiler = "") {
  MjcfDocument document("<mujoco><compiler " + compiler + "/>" + geom + inertial + "</mujoco>", "m.xml");
  const MjcfDefaults defaults(document);
  const auto found = document.sections("inertial");
  return massOf(document, defaults.geom(*document.sections("geom")[0], "main"),
                found.empty() ? nullptr : found[0]);
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

}  // namespace
}  // namespace careen
