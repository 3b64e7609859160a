#include "scene/motion_shape.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace careen {
namespace {

constexpr double kMostFrequency = 1e6;  // [Hz]

std::vector<PathPoint> readPath(const JsonValue& value) {
  std::vector<PathPoint> path;
  for (const JsonValue& point : value.elements("[[time, x, y, z], …]")) {
    const std::vector<JsonValue> numbers = point.elements("[time, x, y, z]", 4);
    PathPoint& added = path.emplace_back();
    added.time = numbers[0].number(nonNegativeNumber("s"));
    for (int axis = 0; axis < 3; ++axis) {
      added.place[axis] = numbers[static_cast<std::size_t>(axis) + 1].number(anyNumber("m"));
    }
  }
  if (path.empty()) {
    value.fail("one point or more");
  }
  return path;
}

void readOscillation(const JsonValue& value, PrescribedMotion& into) {
  const JsonObject object = value.object({"amplitude", "angular_amplitude", "frequency", "phase"});
  into.amplitude = object.vector("amplitude", anyNumber("m"));
  into.swing = object.vector("angular_amplitude", anyNumber("rad"));
  if (!object.has("amplitude") && !object.has("angular_amplitude")) {
    object.fail("neither amplitude nor angular_amplitude", "one of them, or both");
  }
  const NumberRange frequency = {
      .min = kSmallestPositive, .max = kMostFrequency, .unit = "Hz", .plain = "a number above 0, up to 1e6"};
  into.rate = 2 * std::numbers::pi * object.require("frequency").number(frequency);
  into.phase = object.number("phase", anyNumber("rad"), 0);
}

JsonObject motionObject(const JsonValue& motion) {
  return motion.object({"path", "velocity", "angular_velocity", "about", "oscillation"});
}

}  // namespace

bool hasPath(const JsonValue& motion) { return motionObject(motion).has("path"); }

Course readMotion(const JsonValue& motion, const std::optional<JsonValue>& position, const Pose& pose) {
  const JsonObject object = motionObject(motion);
  PrescribedMotion prescribed;
  Pose home = pose;
  if (const std::optional<JsonValue> path = object.find("path")) {
    prescribed.path = readPath(*path);
    home.position = prescribed.path.front().place;
    if (position && home.position != pose.position) {
      position->failAs("a position", "none, as the motion's path tells it, or that of its first point");
    }
  }
  prescribed.velocity = object.vector("velocity", anyNumber("m/s"));
  prescribed.angularVelocity = object.vector("angular_velocity", anyNumber("rad/s"));
  if (const std::optional<JsonValue> oscillation = object.find("oscillation")) {
    readOscillation(*oscillation, prescribed);
  }
  constexpr double kAlong = 1e-9;
  if (prescribed.angularVelocity.cross(prescribed.swing).norm() >
      kAlong * prescribed.angularVelocity.norm() * prescribed.swing.norm()) {
    object.find("oscillation")
        ->failAs("an angular_amplitude about another axis than the angular_velocity", "one axis for both");
  }
  prescribed.about = home.position;
  if (const std::optional<JsonValue> about = object.find("about")) {
    if (prescribed.angularVelocity.isZero(0) && prescribed.swing.isZero(0)) {
      about->failAs("a point that it would turn about", "an angular_velocity or angular_amplitude too");
    }
    prescribed.about = about->vector(anyNumber("m"));
  }
  if (!object.has("path") && !object.has("velocity") && !object.has("angular_velocity") &&
      !object.has("oscillation")) {
    motion.failAs("no motion", "path, velocity, angular_velocity, oscillation, or some of them");
  }
  return courseOf(prescribed, home);
}

}  // namespace careen
