#include "exchange/mjcf_defaults.h"

#include <algorithm>
#include <cstddef>
#include <utility>

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

}  // namespace

const std::string MjcfDefaults::kMain = "main";

MjcfDefaults::MjcfDefaults(MjcfDocument& document) : document_(document) {
  readMaterials();
  MjcfFreeJoint hinge;  // the type of a <joint> that does not say it
  hinge.isFree = false;
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
  Class own = above;
  for (const XmlElement& child : element.children) {
    if (child.name == "geom") {
      apply(child, own.geom);
    } else if (child.name == "joint") {
      apply(child, own.joint);
    } else if (child.name == "site") {
      document_.check(child, {}, {"type", "group", "material", "rgba", "size", "user"});
    } else if (child.name == "pair" || child.name == "tendon") {
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
  return geom;
}

MjcfFreeJoint MjcfDefaults::joint(const XmlElement& element, const std::string& ofBody) const {
  if (element.name == "freejoint") {
    document_.check(element, {"name"}, {"group"});
    return {};
  }
  MjcfFreeJoint joint = classes_.at(classOf(element, "class", ofBody)).joint;
  apply(element, joint);
  return joint;
}

void MjcfDefaults::apply(const XmlElement& element, MjcfGeom& geom) const {
  if (const XmlAttribute* const type = element.find("type")) {
    geom.type = type->value;
  }
  if (geom.element != nullptr && geom.type != "box" && geom.type != "plane") {
    const XmlAttribute* const type = element.find("type");
    document_.tree().fail(type == nullptr ? element.offset : type->offset,
                          "a <geom> of type " + inQuotes(geom.type), "type=\"box\" or type=\"plane\"");
  }
  document_.check(
      element,
      {"name", "class", "type", "size", "pos", "quat", "axisangle", "euler", "xyaxes", "zaxis", "mass",
       "density", "friction", "condim", "contype", "conaffinity", "priority", "rgba", "material"},
      {"group", "solmix", "solref", "solimp", "margin", "gap", "user"});
  geom.name = element.text("name");
  const std::vector<double> size = document_.numbers(element, "size", 1, 3);
  geom.size.resize(std::max(size.size(), geom.size.size()));
  std::copy(size.begin(), size.end(), geom.size.begin());  // fewer leave those of the class
  geom.position = document_.vector(element, "pos", geom.position);
  geom.turn = document_.orientation(element, geom.turn);
  if (element.find("mass") != nullptr) {
    geom.mass = document_.number(element, "mass", 0);
  }
  geom.density = document_.number(element, "density", geom.density);
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

void MjcfDefaults::apply(const XmlElement& element, MjcfFreeJoint& joint) const {
  if (const XmlAttribute* const type = element.find("type")) {
    joint.type = type->value;
    joint.isFree = joint.type == "free";
  }
  if (!joint.isFree) {
    return;  // refused where it is used, defaults of other joints are not
  }
  document_.check(element, {"name", "class", "type", "damping", "stiffness", "armature", "frictionloss"},
                  {"group", "pos", "limited", "axis", "ref", "springref", "springdamper", "range", "margin",
                   "solreflimit", "solimplimit", "solreffriction", "solimpfriction", "user"});
  joint.damping = document_.number(element, "damping", joint.damping);
  if (joint.damping < 0) {
    document_.fail(element, *element.find("damping"), "a number not below 0");
  }
  document_.mustBeZero(element, "stiffness");
  document_.mustBeZero(element, "armature");
  document_.mustBeZero(element, "frictionloss");
}

}  // namespace careen
