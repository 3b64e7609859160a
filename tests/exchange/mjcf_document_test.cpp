#include "exchange/mjcf_document.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/input_error.h"

namespace careen {
namespace {

// The orientation of an element with these attributes.
Mat3 orientationOf(const std::string& attributes, const std::string& compiler = "") {
  const MjcfDocument document("<mujoco><compiler " + compiler + "/><body " + attributes + "/></mujoco>",
                              "m.xml");
  return document.orientation(*document.sections("body")[0], Quat::Identity()).toRotationMatrix();
}
Mat3 aboutAxis(const Vec3& axis, double radians) {
  return Eigen::AngleAxisd(radians, axis.normalized()).toRotationMatrix();
}
double difference(const Mat3& a, const Mat3& b) { return (a - b).norm(); }

TEST(MjcfDocument, readsEveryNotationOfAnOrientation) {
  const double angle = M_PI / 6;
  EXPECT_EQ(orientationOf(""), Mat3(Mat3::Identity()));
  EXPECT_LT(difference(orientationOf("quat=\"2 0 0 2\""), aboutAxis(Vec3::UnitZ(), M_PI / 2)), 1e-15);
  EXPECT_LT(difference(orientationOf("axisangle=\"0 3 4 30\""), aboutAxis({0, 3, 4}, angle)), 1e-15);
  EXPECT_LT(
      difference(orientationOf("axisangle=\"0 3 4 0.5\"", "angle=\"radian\""), aboutAxis({0, 3, 4}, 0.5)),
      1e-15);
  // Small letters: axes that turn along; capital ones: axes that stay.
  const Mat3 x = aboutAxis(Vec3::UnitX(), angle);
  const Mat3 y = aboutAxis(Vec3::UnitY(), 2 * angle);
  const Mat3 z = aboutAxis(Vec3::UnitZ(), -angle);
  EXPECT_LT(difference(orientationOf("euler=\"30 60 -30\""), x * y * z), 1e-15);
  EXPECT_LT(difference(orientationOf("euler=\"30 60 -30\"", "eulerseq=\"XYZ\""), z * y * x), 1e-15);
  EXPECT_LT(difference(orientationOf("euler=\"-30 30 60\"", "eulerseq=\"zXy\""), x * z * y), 1e-15);
  Mat3 axes;
  axes << 0, -1, 0, 1, 0, 0, 0, 0, 1;  // x to y; what of y lies along x counts not
  EXPECT_LT(difference(orientationOf("xyaxes=\"0 5 0 -1 7 0\""), axes), 1e-15);
  EXPECT_LT((orientationOf("zaxis=\"1 2 3\"") * Vec3::UnitZ() - Vec3(1, 2, 3).normalized()).norm(), 1e-15);
  // Close to −z cancellation would cost half of the digits.
  const Vec3 steep = Vec3(1e-7, 0, -1).normalized();
  EXPECT_LT((orientationOf("zaxis=\"1e-7 0 -1\"") * Vec3::UnitZ() - steep).norm(), 1e-15);
  EXPECT_LT(difference(orientationOf("zaxis=\"0 0 -9\""), aboutAxis(Vec3::UnitX(), M_PI)), 1e-15);
  EXPECT_LT(difference(orientationOf("quat=\"1e-60 0 0 1e60\""), aboutAxis(Vec3::UnitZ(), M_PI)), 1e-15);
}

TEST(MjcfDocument, refusesWhatIsNoNumberAtItsPlace) {
  const auto refusal = [](const std::string& value) {
    return inputErrorOf([&] {
      const MjcfDocument document("<mujoco>\n<geom size='" + value + "'/></mujoco>", "m.xml");
      static_cast<void>(document.numbers(*document.sections("geom")[0], "size", 2, 3));
    });
  };
  EXPECT_EQ(refusal("1 +2e-3\n\t-4.5"), "no error");
  EXPECT_EQ(refusal("1 2x"),
            "m.xml:2:7: found \"2x\" in size for <geom>, expected a number from -1e60 to 1e60");
  for (const char* const wrong :
       {"nan 1", "1 inf", "1e400 1", "1 -1e61", "1 ++2", "0x10 1", "1,2", "1 --2"}) {
    EXPECT_NE(refusal(wrong).find("expected a number from"), std::string::npos) << wrong;
  }
  EXPECT_EQ(refusal("1"), "m.xml:2:7: found 1 numbers in size for <geom>, expected 2 to 3");
  EXPECT_EQ(refusal(""), "m.xml:2:7: found 0 numbers in size for <geom>, expected 2 to 3");
}

TEST(MjcfDocument, notesWhatIsIgnoredAndRefusesWhatIsUnknown) {
  MjcfDocument document("<mujoco><geom a='1' b='2' c='3'/></mujoco>", "m.xml");
  const XmlElement& geom = *document.sections("geom")[0];
  EXPECT_EQ(inputErrorOf([&] { document.check(geom, {"a"}, {"b"}); }),
            "m.xml:1:27: found c=\"3\" for <geom>, expected none: it says what a scene of boxes cannot");
  document.check(geom, {"a", "c"}, {"b"});
  EXPECT_EQ(document.ignored(), std::set<std::string>{"geom b"});
}

TEST(MjcfDocument, theLastCompilerCounts) {
  const MjcfDocument document(
      "<mujoco><compiler angle='radian'/><compiler inertiafromgeom='true'/><body euler='1 0 0'/></mujoco>",
      "m.xml");
  EXPECT_EQ(document.compiler().inertiaFromGeom, "true");
  EXPECT_LT(
      difference(document.orientation(*document.sections("body")[0], Quat::Identity()).toRotationMatrix(),
                 aboutAxis(Vec3::UnitX(), 1)),
      1e-15);
}

// As MuJoCo has it, of which older ones take no range without a word about it.
TEST(MjcfDocument, rangesLimitUnlessTheySayOtherwise) {
  const auto isLimited = [](const std::string& compiler, const std::string& limited,
                            const std::array<double, 2>& range) {
    const MjcfDocument document("<mujoco><compiler " + compiler + "/></mujoco>", "m.xml");
    return document.isLimited(document.root(), limited, range);
  };
  EXPECT_TRUE(isLimited("", "auto", {-1, 1}));
  EXPECT_FALSE(isLimited("", "auto", {0, 0}));
  EXPECT_FALSE(isLimited("", "false", {-1, 1}));
  EXPECT_TRUE(isLimited("autolimits=\"false\"", "true", {-1, 1}));
  EXPECT_FALSE(isLimited("autolimits=\"false\"", "auto", {0, 0}));
  EXPECT_NE(inputErrorOf([&] {
              isLimited("autolimits=\"false\"", "auto", {-1, 1});
            }).find("found the range -1 1 for <mujoco>, expected limited="),
            std::string::npos);
  EXPECT_NE(inputErrorOf([&] {
              isLimited("", "true", {1, -1});
            }).find("expected the lower end first"),
            std::string::npos);
}

}  // namespace
}  // namespace careen
