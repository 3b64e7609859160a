#include "scene/control_shape.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace careen {
namespace {

constexpr const char* kCoordinate = "rad or m";

void readSine(const JsonObject& object, MotorTarget& target) {
  const std::vector<JsonValue> numbers =
      object.require("sine").elements("[offset, amplitude, frequency in Hz, phase in rad]", 4);
  target.offset = numbers[0].number(anyNumber(kCoordinate));
  target.amplitude = numbers[1].number(anyNumber(kCoordinate));
  target.frequency = numbers[2].number(nonNegativeNumber("Hz"));
  target.phase = numbers[3].number(anyNumber("rad"));
  target.ramp = object.number("ramp", nonNegativeNumber("s"), 0);
}

void readPath(const JsonValue& value, MotorTarget& target) {
  for (const JsonValue& point : value.elements("[[time, coordinate], …]")) {
    const std::vector<JsonValue> numbers = point.elements("[time, coordinate]", 2);
    target.path.emplace_back(numbers[0].number(nonNegativeNumber("s")),
                             numbers[1].number(anyNumber(kCoordinate)));
  }
  if (target.path.empty()) {
    value.fail("one point or more");
  }
}

MotorTarget readTarget(const JsonValue& value) {
  MotorTarget target;
  if (value.is(JsonNode::Kind::kNumber)) {
    target.offset = value.number(anyNumber(kCoordinate));
    return target;
  }
  const JsonObject object = value.object({"sine", "ramp", "path"});
  if (object.has("sine") == object.has("path")) {
    value.fail("a number, or an object with sine or path");
  }
  if (object.has("sine")) {
    readSine(object, target);
  } else if (object.has("ramp")) {
    object.fail("ramp", "sine beside it");
  } else {
    readPath(object.require("path"), target);
  }
  return target;
}

Motor readMotor(const JsonValue& value) {
  const JsonObject object = value.object({"joint", "max", "target", "kp", "kd", "gains"});
  Motor motor;
  object.require("joint").string("the name of a hinge or slider");
  motor.largest = object.number("max", positiveNumber("N m or N"), kLargestNumber);
  motor.stiffness = object.number("kp", nonNegativeNumber("N m/rad or N/m"), 0);
  motor.damping = object.number("kd", nonNegativeNumber("N m s/rad or N s/m"), 0);
  if (const std::optional<JsonValue> target = object.find("target")) {
    motor.target = readTarget(*target);
  }
  if (const std::optional<JsonValue> gains = object.find("gains")) {
    if (!gains->is(JsonNode::Kind::kObject)) {
      gains->fail("an object: [k, d] by joint");
    }
    for (const JsonValue& gain : gains->members()) {
      const std::vector<JsonValue> numbers = gain.elements("[k, d]", 2);
      motor.gains.push_back(
          {.joint = 0, .k = numbers[0].number(anyNumber()), .d = numbers[1].number(anyNumber("s"))});
    }
  }
  if (!object.has("kp") && !object.has("kd") && !object.has("gains")) {
    object.fail("no kp, kd or gains", "one of them");
  }
  return motor;
}

}  // namespace

Control readControl(const JsonValue& value) {
  const JsonObject object = value.object({"period", "motors"});
  Control control;
  control.period = object.require("period").number(positiveNumber("s"));
  for (const JsonValue& motor : object.require("motors").elements("an array of motors")) {
    control.motors.push_back(readMotor(motor));
  }
  return control;
}

}  // namespace careen
