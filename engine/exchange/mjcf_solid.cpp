#include "exchange/mjcf_solid.h"

#include <algorithm>
#include <numbers>
#include <string>

#include "core/brief.h"
#include "scene/json_shape.h"
#include "scene/json_tree.h"

namespace careen {
namespace {

constexpr double kPi = std::numbers::pi;

/// Of a body of density 1.
struct UnitSolid {
  double volume = 0;
  Vec3 moments = Vec3::Zero();  // [m²] for each kg
};

Vec3 sumsOfOthers(const Vec3& v) { return {v.y() + v.z(), v.x() + v.z(), v.x() + v.y()}; }

// A cylinder between two halves of a ball, whose centres are 3/8 of the radius from its ends.
UnitSolid capsule(double radius, double half) {
  const double ball = 4.0 / 3.0 * kPi * radius * radius * radius;
  const double cylinder = 2 * kPi * radius * radius * half;
  const double square = radius * radius;
  const double along = (cylinder * square / 2 + ball * 0.4 * square) / (ball + cylinder);
  const double across =
      (cylinder * (square / 4 + half * half / 3) + ball * (0.4 * square + half * (half + 0.75 * radius))) /
      (ball + cylinder);
  return {.volume = ball + cylinder, .moments = {across, across, along}};
}

UnitSolid unitSolid(const MjcfDocument& document, const MjcfGeom& geom) {
  const auto sized = [&](std::size_t count) {
    checkSize(document, geom, count);
    return geom.size;
  };
  if (geom.type == "sphere") {
    const double radius = sized(1)[0];
    return {.volume = 4.0 / 3.0 * kPi * radius * radius * radius,
            .moments = Vec3::Constant(0.4 * radius * radius)};
  }
  if (geom.type == "capsule") {
    const std::vector<double> size = sized(2);
    return capsule(size[0], size[1]);
  }
  if (geom.type == "cylinder") {
    const std::vector<double> size = sized(2);
    const double square = size[0] * size[0];
    const double across = square / 4 + size[1] * size[1] / 3;
    return {.volume = 2 * kPi * square * size[1], .moments = {across, across, square / 2}};
  }
  const std::vector<double> size = sized(3);
  const Vec3 half(size[0], size[1], size[2]);
  const Vec3 squares = sumsOfOthers(half.cwiseAbs2());
  if (geom.type == "ellipsoid") {
    return {.volume = 4.0 / 3.0 * kPi * half.prod(), .moments = squares / 5};
  }
  return {.volume = 8 * half.prod(), .moments = squares / 3};
}

}  // namespace

void checkSize(const MjcfDocument& document, const MjcfGeom& geom, std::size_t count) {
  const XmlAttribute* const size = geom.element->find("size");
  const auto fail = [&](const std::string& found) {
    document.tree().fail(
        size == nullptr ? geom.element->offset : size->offset, found,
        (count == 3 ? "3 half extents" : std::to_string(count) + " radii or half lengths") + " above 0 [m]");
  };
  if (!geom.mesh.empty()) {
    document.fail(*geom.element, "a " + geom.type + " that takes its size from a mesh", "one with a size");
  }
  if (geom.size.size() < count) {
    fail(std::to_string(geom.size.size()) + " numbers for the size of a " + geom.type);
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (geom.size[i] < kSmallestPositive) {
      fail(brief(geom.size[i]) + " in the size of a " + geom.type);
    }
  }
}

MjcfSolid solidOf(const MjcfDocument& document, const MjcfGeom& geom) {
  if (geom.type == "plane" || geom.type == "hfield" || (geom.mass ? *geom.mass : geom.density) == 0) {
    return {};
  }
  if (geom.type == "mesh" || geom.type == "sdf" || geom.isShell) {
    document.fail(*geom.element,
                  geom.isShell ? "a shell whose mass counts"
                               : "a <geom> of type " + inQuotes(geom.type) + " whose mass counts",
                  "mass=\"0\", <inertial>, or a solid box, sphere, capsule, cylinder or ellipsoid");
  }
  const UnitSolid unit = unitSolid(document, geom);
  const double mass = geom.mass.value_or(geom.density * unit.volume);
  return {.mass = mass, .moments = mass * unit.moments};
}

}  // namespace careen
