#include "exchange/mjcf_defaults.h"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <utility>

#include "core/brief.h"
#include "scene/json_tree.h"

namespace careen {
namespace {

constexpr std::array<double, 3> kGray = {0.5, 0.5, 0.5};  // MuJoCo takes the material's colour in its place

std::optional<std::array<double, 3>> colorOf(const MjcfDocument& document, const XmlElement& element) {
  const std::vector<double> rgba = document.numbers(element, "rgba", 4, 4);
  if (rgba.empty()) {
    return std::nullopt;
  }
  return std::array<double, 3>{rgba[0], rgba[1], rgba[2]};
}

bool isActuator(const XmlElement& element) {
  return element.name == "motor" || element.name == "position" || element.name == "velocity" ||
         element.name == "general";
}

// It would give key frames another meaning.
void mustNotAlign(const MjcfDocument& document, const XmlElement& joint) {
  if (joint.text("align") == "true") {
    document.fail(joint, *joint.find("align"), "the body's frame where it is");
  }
}

}  // namespace

const std::string MjcfDefaults::kMain = "main";

MjcfDefaults::MjcfDefaults(MjcfDocument& document) : document_(document) {
  readMaterials();
  MjcfJoint hinge;  // the type of a <joint> that does not say it
  hinge.type = "hinge";
  classes_[kMain] = {.geom = {}, .joint = hinge};
  for (const XmlElement* const top : document_.sections("default")) {
    const Class above = classes_.at(kMain);
    read(*top, above, true);
  }
}

void MjcfDefaults::readMaterials() {
  for (const XmlElement* const assets : document_.sections("asset")) {
    for (const XmlElement& asset : assets->children) {
      const auto color = asset.name == "material" ? colorOf(document_, asset) : std::nullopt;
      if (color) {
        materials_[asset.text("name")] = *color;
      }
      document_.ignore("asset " + asset.name);
    }
  }
}

void MjcfDefaults::read(const XmlElement& element, const Class& above, bool isTop) {
  document_.check(element, {"class"});
  const XmlAttribute* const named = element.find("class");
  if (named == nullptr && !isTop) {
    document_.fail(element, "<default> without a class", "class=\"…\" for a <default> in another");
  }
  const std::string name = named == nullptr ? kMain : named->value;
  if (!isTop && classes_.contains(name)) {
    document_.fail(element, *named, "a name that no other class has");
  }
  const bool hasActuators = !document_.sections("actuator").empty();
  Class own = above;
  for (const XmlElement& child : element.children) {
    if (child.name == "geom") {
      apply(child, own.geom);
    } else if (child.name == "joint") {
      apply(child, own.joint);
    } else if (child.name == "site") {
      document_.check(child, {}, {"type", "group", "material", "rgba", "size", "user"});
    } else if (child.name == "pair" || child.name == "tendon" || (isActuator(child) && hasActuators)) {
      document_.fail(child, "<" + child.name + "> in <default>",
                     "each <" + child.name + "> to say all itself");
    } else if (child.name != "default") {
      document_.ignore("default " + child.name);
    }
  }
  classes_[name] = own;
  if (isTop) {
    classes_[kMain] = own;  // by whatever name, it is what all take after
  }
  for (const XmlElement& child : element.children) {
    if (child.name == "default") {
      read(child, own, false);
    }
  }
}

const std::string& MjcfDefaults::classOf(const XmlElement& element, std::string_view attribute,
                                         const std::string& whenAbsent) const {
  const XmlAttribute* const named = element.find(attribute);
  if (named == nullptr) {
    return whenAbsent;
  }
  if (!classes_.contains(named->value)) {
    document_.fail(element, *named, "a class of <default>");
  }
  return named->value;
}

MjcfGeom MjcfDefaults::geom(const XmlElement& element, const std::string& ofBody) const {
  MjcfGeom geom = classes_.at(classOf(element, "class", ofBody)).geom;
  geom.element = &element;
  apply(element, geom);
  if (!geom.fromTo.empty()) {
    placeBetween(geom);
  }
  return geom;
}

MjcfJoint MjcfDefaults::joint(const XmlElement& element, const std::string& ofBody) const {
  MjcfJoint joint;
  if (element.name == "freejoint") {
    document_.check(element, {"name", "align"}, {"group"});
    mustNotAlign(document_, element);
  } else {
    joint = classes_.at(classOf(element, "class", ofBody)).joint;
    apply(element, joint);
  }
  joint.element = &element;
  joint.name = element.text("name");
  check(joint);
  if (joint.type == "hinge") {
    for (double* const angle : {joint.range.data(), &joint.range[1], &joint.ref, &joint.springRef}) {
      *angle = document_.radians(*angle);
    }
  }
  return joint;
}

void MjcfDefaults::apply(const XmlElement& element, MjcfGeom& geom) const {
  document_.check(
      element, {"name",   "class", "type",     "size", "pos",     "quat",        "axisangle", "euler",
                "xyaxes", "zaxis", "fromto",   "mass", "density", "friction",    "condim",    "contype",
                "group",  "rgba",  "material", "mesh", "hfield",  "conaffinity", "priority",  "shellinertia"},
      {"solmix", "solref", "solimp", "margin", "gap", "user", "fitscale", "fluidshape", "fluidcoef"});
  geom.name = element.text("name");
  applyShape(element, geom);
  applyContact(element, geom);
  applyColor(element, geom);
}

void MjcfDefaults::applyShape(const XmlElement& element, MjcfGeom& geom) const {
  if (const XmlAttribute* const type = element.find("type")) {
    const auto& known = {"plane",    "hfield", "sphere", "capsule", "ellipsoid",
                         "cylinder", "box",    "mesh",   "sdf"};
    if (std::find(known.begin(), known.end(), type->value) == known.end()) {
      document_.fail(element, *type, "a type of <geom>");
    }
    geom.type = type->value;
  }
  if (const XmlAttribute* const mesh = element.find("mesh")) {
    geom.mesh = mesh->value;
  }
  const std::vector<double> size = document_.numbers(element, "size", 1, 3);
  geom.size.resize(std::max(size.size(), geom.size.size()));
  std::copy(size.begin(), size.end(), geom.size.begin());  // fewer leave those of the class
  geom.position = document_.vector(element, "pos", geom.position);
  geom.turn = document_.orientation(element, geom.turn);
  if (element.find("fromto") != nullptr) {
    geom.fromTo = document_.numbers(element, "fromto", 6, 6);
  }
  if (element.find("mass") != nullptr) {
    geom.mass = document_.positive(element, "mass", 0);
  }
  geom.density = document_.positive(element, "density", geom.density);
  if (const XmlAttribute* const shell = element.find("shellinertia")) {
    geom.isShell = shell->value == "true";
  }
  geom.group = document_.integer(element, "group", geom.group);
}

void MjcfDefaults::applyContact(const XmlElement& element, MjcfGeom& geom) const {
  const std::vector<double> friction = document_.numbers(element, "friction", 1, 3);
  if (!friction.empty()) {
    geom.friction = friction[0];
    if (geom.friction < 0) {
      document_.fail(element, *element.find("friction"), "numbers not below 0");
    }
  }
  geom.condim = document_.integer(element, "condim", geom.condim);
  if (geom.condim != 1 && geom.condim != 3 && geom.condim != 4 && geom.condim != 6) {
    document_.fail(element, *element.find("condim"), "1, 3, 4 or 6");
  }
  if (geom.condim > 3) {
    document_.ignore("friction against spinning and rolling (condim " + std::to_string(geom.condim) + ")");
  }
  geom.contype = document_.integer(element, "contype", geom.contype);
  geom.conaffinity = document_.integer(element, "conaffinity", geom.conaffinity);
  geom.priority = document_.integer(element, "priority", geom.priority);
}

void MjcfDefaults::applyColor(const XmlElement& element, MjcfGeom& geom) const {
  if (element.find("material") != nullptr) {
    document_.ignore("geom material, but for its colour");
    const auto material = materials_.find(element.text("material"));
    if (material != materials_.end() && (!geom.color || *geom.color == kGray)) {
      geom.color = material->second;
    }
  }
  const auto color = colorOf(document_, element);
  if (color && (*color != kGray || !geom.color)) {
    geom.color = color;
  }
}

// Between the two points lies its z axis, from the second to the first; the others are as long as the first
// number of its size. Orientations do not count.
void MjcfDefaults::placeBetween(MjcfGeom& geom) const {
  const XmlElement& element = *geom.element;
  const XmlAttribute* const given = element.find("fromto");
  const auto fail = [&](const std::string& found, const std::string& expected) {
    document_.tree().fail(given == nullptr ? element.offset : given->offset, found, expected);
  };
  if (geom.type != "box" && geom.type != "capsule" && geom.type != "cylinder" && geom.type != "ellipsoid") {
    fail("fromto for a <geom> of type " + inQuotes(geom.type), "a box, capsule, cylinder or ellipsoid");
  }
  if (!geom.position.isZero(0)) {
    fail("pos and fromto for <geom>", "one of them");
  }
  const Vec3 first(geom.fromTo[0], geom.fromTo[1], geom.fromTo[2]);
  const Vec3 second(geom.fromTo[3], geom.fromTo[4], geom.fromTo[5]);
  const double half = (first - second).stableNorm() / 2;
  const std::optional<Quat> turn = MjcfDocument::turnToZ(first - second);
  if (!turn || half < 1e-14) {
    fail("a length of " + brief(2 * half) + " m by fromto", "two points apart");
  }
  geom.size.resize(1);
  if (geom.type == "box" || geom.type == "ellipsoid") {
    geom.size.push_back(geom.size[0]);
  }
  geom.size.push_back(half);
  geom.position = (first + second) / 2;
  geom.turn = *turn;
}

void MjcfDefaults::apply(const XmlElement& element, MjcfJoint& joint) const {
  document_.check(
      element,
      {"name", "class", "type", "pos", "axis", "limited", "range", "ref", "springref", "springdamper",
       "damping", "stiffness", "armature", "frictionloss", "align"},
      {"group", "margin", "solreflimit", "solimplimit", "solreffriction", "solimpfriction", "user"});
  joint.type = document_.word(element, "type", {"free", "ball", "slide", "hinge"}, joint.type);
  joint.limited = document_.word(element, "limited", {"false", "true", "auto"}, joint.limited);
  joint.position = document_.vector(element, "pos", joint.position);
  joint.axis = document_.vector(element, "axis", joint.axis);
  if (const std::vector<double> range = document_.numbers(element, "range", 2, 2); !range.empty()) {
    joint.range = {range[0], range[1]};
  }
  joint.ref = document_.number(element, "ref", joint.ref);
  joint.springRef = document_.number(element, "springref", joint.springRef);
  joint.damping = document_.positive(element, "damping", joint.damping);
  joint.stiffness = document_.positive(element, "stiffness", joint.stiffness);
  joint.friction = document_.positive(element, "frictionloss", joint.friction);
  joint.armature = document_.number(element, "armature", joint.armature);
  document_.mustBeZero(element, "springdamper");
  mustNotAlign(document_, element);
}

// Of a class these are refused where they are used.
void MjcfDefaults::check(const MjcfJoint& joint) const {
  const auto refuse = [&](const char* attribute, const std::string& value) {
    const XmlAttribute* const given = joint.element->find(attribute);
    document_.tree().fail(
        given == nullptr ? joint.element->offset : given->offset,
        std::string(attribute) + "=" + inQuotes(value) + " for a joint of type " + inQuotes(joint.type),
        "none: joints of scenes have no such thing");
  };
  const auto mustBeZero = [&](const char* attribute, double value) {
    if (value != 0) {
      refuse(attribute, brief(value));
    }
  };
  mustBeZero("armature", joint.armature);
  if (!joint.hasCoordinate()) {
    mustBeZero("frictionloss", joint.friction);
    mustBeZero("stiffness", joint.stiffness);
  }
  if (joint.isBall()) {
    mustBeZero("damping", joint.damping);
    if (document_.isLimited(*joint.element, joint.limited, joint.range)) {
      refuse("range", brief(joint.range[0]) + " " + brief(joint.range[1]));
    }
  }
}

}  // namespace careen
