// Key frames of bodies in bodies; beside MuJoCo in import_mjcf_random_test.
#include "exchange/mjcf_start.h"

#include <gtest/gtest.h>

#include "support/input_error.h"

namespace careen {
namespace {

MjcfModel startOf(const std::string& elements) {
  MjcfDocument document("<mujoco><compiler angle=\"radian\"/>" + elements + "</mujoco>", "m.xml");
  return readModel(document);
}
std::string refusalOfStart(const std::string& elements) {
  return inputErrorOf([&] { startOf(elements); });
}
std::string keyFrame(const std::string& places, const std::string& speeds) {
  return "</worldbody><keyframe><key name=\"start\" qpos=\"" + places + "\" qvel=\"" + speeds +
         "\"/></keyframe>";
}
const std::string kStartingBox = R"(<geom type="box" size="0.1 0.1 0.1"/>)";

// An arm that hangs 1 m below a hinge about y, turned up by a quarter; at its end, 1 m further, a slide along
// it by 0.5 m, whose coordinate is 0.25 as it stands.
TEST(MjcfStart, hingesTurnAndSlidesMove) {
  const MjcfModel model = startOf(
      R"(<worldbody><body name="arm" pos="0 0 -1"><joint type="hinge" axis="0 1 0" pos="0 0 1"/>)" +
      kStartingBox + R"(<body name="tip" pos="0 0 -1"><joint type="slide" axis="0 0 -1" ref="0.25"/>)" +
      kStartingBox + "</body></body>" + keyFrame("-1.5707963267948966 0.75", "2 3"));
  // About y by −90° −z becomes x.
  EXPECT_LT((model.surfaces[0].frame.position - Vec3(1, 0, 0)).norm(), 1e-15);
  EXPECT_LT((model.surfaces[1].frame.position - Vec3(2.5, 0, 0)).norm(), 1e-15);
  EXPECT_EQ(model.surfaces[1].coordinate, 0.75);
  // 2 rad/s about y move x to −z; the slide moves along x.
  EXPECT_LT((model.surfaces[0].angularVelocity - Vec3(0, 2, 0)).norm(), 1e-15);
  EXPECT_LT((model.surfaces[0].velocity - Vec3(0, 0, -2)).norm(), 1e-15);
  EXPECT_LT((model.surfaces[1].angularVelocity - Vec3(0, 2, 0)).norm(), 1e-15);
  EXPECT_LT((model.surfaces[1].velocity - Vec3(3, 0, -5)).norm(), 5e-15);
}

// A ball at the end of a free box, which turns it by half a turn about x and has its speed along its own
// axes.
TEST(MjcfStart, ballsTurnAlongTheirOwnAxes) {
  const MjcfModel model =
      startOf("<worldbody><body><freejoint/>" + kStartingBox +
              R"(<body pos="2 0 0"><joint type="ball" pos="-1 0 0"/>)" + kStartingBox + "</body></body>" +
              keyFrame("0 0 5 1 0 0 0  0 1 0 0", "1 0 0 0 0 1  0 0 4"));
  EXPECT_LT((model.surfaces[1].frame.position - Vec3(2, 0, 5)).norm(), 1e-15);
  // Its own z is −z: 1 − 4 about z. The ball's place moves with 1 m/s along x and y.
  EXPECT_LT((model.surfaces[1].angularVelocity - Vec3(0, 0, -3)).norm(), 1e-15);
  EXPECT_LT((model.surfaces[1].velocity - Vec3(1, -2, 0)).norm(), 1e-15);
}

TEST(MjcfStart, bodiesWithoutAJointMoveWithTheirParent) {
  const MjcfModel model = startOf("<worldbody><body><freejoint/>" + kStartingBox + R"(<body pos="2 0 0">)" +
                                  kStartingBox + "</body></body>" + keyFrame("0 0 5 0 0 0 1", "0 0 0 0 0 3"));
  EXPECT_LT((model.surfaces[1].frame.position - Vec3(-2, 0, 5)).norm(), 1e-15);
  EXPECT_LT((model.surfaces[1].velocity - Vec3(0, -6, 0)).norm(), 1e-14);
}

TEST(MjcfStart, refusesWhereNoJointOfASceneStarts) {
  const auto arm = [](const std::string& joint) {
    return "<worldbody><body>\n<joint " + joint + "/>" + kStartingBox + "</body>";
  };
  EXPECT_EQ(
      refusalOfStart(arm(R"(range="0.1 1")") + "</worldbody>"),
      "m.xml:2:2: found a joint that starts at 0, out of its range 0.1 to 1, expected a start within it");
  EXPECT_NE(
      refusalOfStart(arm(R"(range="-1 1")") + keyFrame("1.5", "0")).find("found a joint that starts at 1.5"),
      std::string::npos);
  EXPECT_NE(refusalOfStart(arm(R"(range="-4 4")") + "</worldbody>").find("found a range of a turn or more"),
            std::string::npos);
  EXPECT_EQ(refusalOfStart(arm(R"(type="slide" range="-4 4")") + "</worldbody>"), "no error");
  EXPECT_NE(refusalOfStart(arm(R"(stiffness="1" springref="3.5")") + "</worldbody>")
                .find("found a spring that rests half a turn or more from the start"),
            std::string::npos);
  EXPECT_NE(
      refusalOfStart(arm("") + keyFrame("0 0", "0")).find("found 2 numbers in qpos for <key>, expected 1"),
      std::string::npos);
  EXPECT_NE(refusalOfStart(arm(R"(ref="1e20")") + "</worldbody>").find("found a joint that starts at 1e+20"),
            std::string::npos);
  EXPECT_NE(refusalOfStart(arm("") + keyFrame("1e60", "0")).find("expected angles of fewer turns"),
            std::string::npos);
}

}  // namespace
}  // namespace careen
