#include "scene/control_shape.h"

#include <gtest/gtest.h>

#include <string>

#include "support/input_error.h"

namespace careen {
namespace {

Control read(const std::string& text) {
  const JsonTree tree(text, "f");
  return readControl(JsonValue(tree, tree.root(), "control"));
}

std::string errorOf(const std::string& text) {
  return inputErrorOf([&text] { read(text); });
}

TEST(ControlShape, readsEveryKey) {
  const Control control = read(R"({"period": 0.5, "motors": [
      {"joint": "knee", "max": 40, "target": {"sine": [1, 2, 3, 4], "ramp": 5}, "kp": 6, "kd": 7},
      {"joint": "hip", "gains": {"hip": [1, -2], "knee": [3, 4]}},
      {"joint": "hip", "target": {"path": [[0, 1], [2, 3]]}, "kd": 1},
      {"joint": "hip", "target": -2, "kp": 1}]})");
  EXPECT_EQ(control.period, 0.5);
  ASSERT_EQ(control.motors.size(), 4U);
  const Motor& knee = control.motors[0];
  EXPECT_EQ(knee.largest, 40);
  EXPECT_EQ(knee.target.offset, 1);
  EXPECT_EQ(knee.target.amplitude, 2);
  EXPECT_EQ(knee.target.frequency, 3);
  EXPECT_EQ(knee.target.phase, 4);
  EXPECT_EQ(knee.target.ramp, 5);
  EXPECT_EQ(knee.stiffness, 6);
  EXPECT_EQ(knee.damping, 7);
  ASSERT_EQ(control.motors[1].gains.size(), 2U);
  EXPECT_EQ(control.motors[1].gains[0].d, -2);
  EXPECT_EQ(control.motors[1].gains[1].k, 3);
  EXPECT_EQ(control.motors[2].target.path.back().second, 3);
  EXPECT_EQ(control.motors[3].target.offset, -2);
}

TEST(ControlShape, saysWhatIsWrong) {
  const auto expectError = [](const std::string& motor, const std::string& says) {
    const std::string found = errorOf(R"({"period": 1, "motors": [)" + motor + "]}");
    EXPECT_NE(found.find(says), std::string::npos) << found;
  };
  expectError(R"({"kp": 1})", "joint");
  expectError(R"({"joint": "a"})", "no kp, kd or gains");
  expectError(R"({"joint": "a", "kp": -1})", "not below 0");
  expectError(R"({"joint": "a", "kp": 1, "max": 0})", "above 0");
  expectError(R"({"joint": "a", "kp": 1, "target": {}})", "sine or path");
  expectError(R"({"joint": "a", "kp": 1, "target": {"path": [[0, 1]], "ramp": 1}})", "ramp");
  expectError(R"({"joint": "a", "kp": 1, "target": {"path": []}})", "one point or more");
  expectError(R"({"joint": "a", "kp": 1, "speed": 2})", "speed");
  expectError(R"({"joint": "a", "gains": [1, 2]})", "[k, d] by joint");
  EXPECT_NE(errorOf(R"({"period": 0, "motors": []})").find("above 0"), std::string::npos);
}

}  // namespace
}  // namespace careen
