#include "scene/parts_shape.h"

#include <cmath>
#include <optional>
#include <string>

#include "core/math/rotation.h"
#include "stage/turn.h"

namespace careen {
namespace {

Mat3 readAxisAngle(const JsonValue& value) {
  const JsonObject object = value.object({"axis", "angle_deg"});
  const Vec3 axis = object.require("axis").direction();
  return rotationAbout(axis, turnFrom(object.require("angle_deg").number(anyNumber("deg"))));
}

Mat3 readQuaternion(const JsonValue& value) {
  const std::vector<JsonValue> parts = value.elements("[w, x, y, z] or an axis and an angle_deg", 4);
  Quat rotation(parts[0].number(anyNumber()), parts[1].number(anyNumber()), parts[2].number(anyNumber()),
                parts[3].number(anyNumber()));
  const double largest = rotation.coeffs().cwiseAbs().maxCoeff();
  if (largest == 0) {
    value.failAs("a zero quaternion", "a rotation");
  }
  rotation.coeffs() /= largest;  // tiny components would square to 0
  return rotation.normalized().toRotationMatrix();
}

}  // namespace

Mat3 readOrientation(const JsonValue& value) {
  return value.is(JsonNode::Kind::kObject) ? readAxisAngle(value) : readQuaternion(value);
}

std::vector<BodyPart> readParts(const JsonValue& value) {
  const std::string expected = "an array of 1 to " + std::to_string(Body::kMostParts) + " boxes";
  const std::vector<JsonValue> each = value.elements(expected);
  if (each.empty() || each.size() > Body::kMostParts) {
    value.fail(expected);
  }
  std::vector<BodyPart> parts;
  for (const JsonValue& element : each) {
    const JsonObject object = element.object({"half_extents", "position", "orientation"});
    BodyPart& part = parts.emplace_back();
    part.halfExtents = object.require("half_extents").vector(positiveNumber("m"));
    part.center = object.vector("position", anyNumber("m"));
    if (const std::optional<JsonValue> orientation = object.find("orientation")) {
      part.bodyFromPart = readOrientation(*orientation);
      part.turned = part.bodyFromPart != Mat3::Identity();
      part.center = part.bodyFromPart.transpose() * part.center;
    }
  }
  return parts;
}

}  // namespace careen
