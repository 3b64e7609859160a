#include "exchange/mjcf_shape.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "core/brief.h"
#include "exchange/mjcf_solid.h"
#include "physics/world/body.h"
#include "scene/json_tree.h"

namespace careen {
namespace {

Vec3 halfSizesOf(const MjcfGeom& box) { return {box.size[0], box.size[1], box.size[2]}; }

void mustTouchAlike(const MjcfDocument& document, const MjcfGeom& first, const MjcfGeom& other) {
  const auto mustAgree = [&](const char* attribute, double one, double two) {
    if (one != two) {
      const XmlAttribute* const given = other.element->find(attribute);
      document.tree().fail(
          given == nullptr ? other.element->offset : given->offset,
          std::string(attribute) + " " + brief(two) + " in a body that has a <geom> with " + brief(one),
          "one for all geoms of a body that collide");
    }
  };
  mustAgree("friction", first.friction, other.friction);
  mustAgree("condim", std::min(first.condim, 3), std::min(other.condim, 3));
  mustAgree("contype", first.contype, other.contype);
  mustAgree("conaffinity", first.conaffinity, other.conaffinity);
  mustAgree("priority", first.priority, other.priority);
}

// In the body's frame, with what all have in common.
MjcfGeom boxAround(const std::vector<MjcfGeom>& parts) {
  Vec3 reach = Vec3::Zero();
  for (const MjcfGeom& part : parts) {
    const Vec3 own = part.turn.toRotationMatrix().cwiseAbs() * halfSizesOf(part);
    reach = reach.cwiseMax(Vec3(part.position.cwiseAbs() + own));
  }
  MjcfGeom box = parts.front();
  box.size = {reach.x(), reach.y(), reach.z()};
  box.position = Vec3::Zero();
  box.turn = Quat::Identity();
  return box;
}

}  // namespace

void checkBox(const MjcfDocument& document, const MjcfGeom& geom) {
  if (geom.type != "box") {
    const XmlAttribute* const type = geom.element->find("type");
    document.tree().fail(type == nullptr ? geom.element->offset : type->offset,
                         "a <geom> of type " + inQuotes(geom.type), R"(type="box" or type="plane")");
  }
  checkSize(document, geom, 3);
}

MjcfShape shapeOf(MjcfDocument& document, const XmlElement& body, const std::vector<MjcfGeom>& geoms,
                  const std::function<bool(const MjcfGeom&)>& collides) {
  std::vector<MjcfGeom> colliding;
  std::vector<MjcfGeom> boxes;
  for (const MjcfGeom& geom : geoms) {
    if (geom.type == "plane") {
      document.fail(*geom.element, "a plane in a body that moves", "boxes");
    }
    if (geom.type == "box") {
      boxes.push_back(geom);
    }
    if (collides(geom)) {
      colliding.push_back(geom);
    }
  }
  std::vector<MjcfGeom>& found = colliding.empty() ? boxes : colliding;
  if (found.empty()) {
    document.fail(body,
                  geoms.empty() ? "a body that moves, without a <geom>"
                                : "a body that moves, without a <geom> that collides",
                  "a box, or several");
  }
  if (found.size() > Body::kMostParts) {
    document.fail(*found[Body::kMostParts].element, "one <geom> more in a body that moves",
                  "at most " + std::to_string(Body::kMostParts) + " that collide");
  }
  for (const MjcfGeom& geom : found) {
    checkBox(document, geom);
    mustTouchAlike(document, found.front(), geom);
  }
  if (geoms.size() > found.size()) {
    document.ignore("geom that collides with nothing");
  }
  MjcfShape shape{.geom = found.size() > 1 ? boxAround(found) : found.front(), .parts = {}};
  if (found.size() > 1) {
    shape.parts = std::move(found);
  }
  for (const std::vector<MjcfGeom>* const some : {&std::as_const(shape.parts), &geoms}) {
    for (const MjcfGeom& geom : *some) {
      if (!shape.geom.color) {
        shape.geom.color = geom.color;
      }
      if (some == &shape.parts && geom.color != shape.geom.color) {
        document.ignore("geom colours of one body but the first");
      }
    }
  }
  return shape;
}

}  // namespace careen
