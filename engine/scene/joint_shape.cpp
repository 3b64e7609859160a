#include "scene/joint_shape.h"

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/elementary.h"

namespace careen {
namespace {

using JointKind = Joint::Kind;

bool takes(JointKind kind, std::string_view key) {
  const bool isLine = kind == JointKind::kRod || kind == JointKind::kRope;
  const bool hasCoordinate = kind == JointKind::kHinge || kind == JointKind::kSlider;
  return key == "at"                          ? !isLine
         : key == "points" || key == "length" ? isLine
         : key == "restitution"               ? hasCoordinate || kind == JointKind::kRope
                                              : hasCoordinate;
}

// Right-handed, with the axis as z. The x axis is that of the world which is least along it, as far as it
// can.
Mat3 frameAbout(const Vec3& axis) {
  Eigen::Index least = 0;
  axis.cwiseAbs().minCoeff(&least);
  const Vec3 x = (Vec3::Unit(least) - axis[least] * axis).normalized();
  Mat3 frame;
  frame.col(0) = x;
  frame.col(1) = axis.cross(x);
  frame.col(2) = axis;
  return frame;
}

// Where the first end is at the start, of a joint whose ends' frames coincide.
void beginAt(Joint& joint, double start) {
  const Vec3 axis = joint.to.axes.col(2);
  if (joint.kind == JointKind::kSlider) {
    joint.to.point -= start * axis;
  } else if (start != 0) {
    const auto turn = elementary::sinCos(start);
    const Vec3 x = joint.from.axes.col(0);
    const Vec3 y = joint.from.axes.col(1);
    joint.from.axes.col(0) = turn.cos * x + turn.sin * y;
    joint.from.axes.col(1) = turn.cos * y - turn.sin * x;
  }
}

void readLoad(const JsonObject& object, Joint& joint) {
  const bool turns = joint.kind == JointKind::kHinge;
  if (const std::optional<JsonValue> given = object.find("spring")) {
    const JsonObject spring = given->object({"stiffness", "rest"});
    joint.stiffness = spring.require("stiffness").number(nonNegativeNumber(turns ? "N m/rad" : "N/m"));
    joint.rest = spring.number("rest", anyNumber(turns ? "rad" : "m"), 0);
  }
  joint.damping = object.number("damping", nonNegativeNumber(turns ? "N m s/rad" : "N s/m"), 0);
  const NumberRange effort = nonNegativeNumber(turns ? "N m" : "N");
  joint.grip = object.number("friction", effort, 0);
  if (const std::optional<JsonValue> given = object.find("drive")) {
    if (object.has("friction")) {
      given->fail("none beside friction: both are one law, and friction that of speed 0");
    }
    const JsonObject drive = given->object({"speed", "max"});
    joint.keptRate = drive.require("speed").number(anyNumber(turns ? "rad/s" : "m/s"));
    joint.grip = drive.require("max").number(effort);
  }
}

}  // namespace

Joint readJoint(const JsonValue& value, std::size_t index) {
  const JsonObject object =
      value.object({"name", "type", "between", "at", "axis", "points", "length", "range", "start", "spring",
                    "damping", "friction", "drive", "restitution", "collide", "until"});
  Joint joint{.name = object.name("joint-" + std::to_string(index)), .from = {}, .to = {}};
  joint.kind = static_cast<JointKind>(
      object.require("type").word({kJointKindNames.begin(), kJointKindNames.end()}, "type of joint"));
  const std::string type(kJointKindNames.at(static_cast<std::size_t>(joint.kind)));
  for (const char* key : {"at", "axis", "points", "length", "range", "start", "spring", "damping", "friction",
                          "drive", "restitution"}) {
    if (const std::optional<JsonValue> given = object.find(key); given && !takes(joint.kind, key)) {
      given->fail("none: a joint of type " + type + " has no " + key);
    }
  }
  const std::string name = R"([name, name] of two boxes, or of one and "world")";
  for (const JsonValue& end : object.require("between").elements(name, 2)) {
    end.string(R"(the name of a box, or "world")");
  }
  if (takes(joint.kind, "points")) {
    const std::vector<JsonValue> points =
        object.require("points").elements("[[x, y, z], [x, y, z]] of both ends [m]", 2);
    joint.from.point = points[0].vector(anyNumber("m"));
    joint.to.point = points[1].vector(anyNumber("m"));
  } else if (joint.kind != JointKind::kFixed || object.has("at")) {
    joint.from.point = object.require("at").vector(anyNumber("m"));
    joint.to.point = joint.from.point;
  }
  if (takes(joint.kind, "axis")) {
    joint.from.axes = frameAbout(object.require("axis").direction());
    joint.to.axes = joint.from.axes;
    beginAt(joint, object.number("start", anyNumber(joint.kind == JointKind::kHinge ? "rad" : "m"), 0));
    readLoad(object, joint);
  }
  joint.length = object.number("length", positiveNumber("m"), 0);
  if (const std::optional<JsonValue> range = object.find("range")) {
    const NumberRange number = anyNumber(joint.kind == JointKind::kHinge ? "rad" : "m");
    const std::vector<JsonValue> ends = range->elements("[lowest, highest]", 2);
    joint.lowest = ends[0].number(number);
    joint.highest = ends[1].number(number);
  }
  joint.restitution = object.number("restitution", kUnitRange, 0);
  joint.until = object.number("until", positiveNumber("s"), Joint::kFree);
  if (const std::optional<JsonValue> collide = object.find("collide")) {
    collide->boolean();
  }
  return joint;
}

void readPassThrough(const JsonValue& value) {
  const std::vector<JsonValue> names = value.elements("an array of names of boxes");
  if (names.size() < 2) {
    value.fail("two names of boxes or more");
  }
  for (const JsonValue& name : names) {
    name.string("the name of a box");
  }
}

}  // namespace careen
