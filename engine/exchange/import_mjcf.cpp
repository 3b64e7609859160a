#include "exchange/import_mjcf.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>
#include <vector>

#include "core/brief.h"
#include "core/math/linear_algebra.h"
#include "exchange/import_mjcf_joints.h"
#include "exchange/mjcf_contacts.h"
#include "exchange/mjcf_document.h"
#include "exchange/mjcf_links.h"
#include "exchange/mjcf_model.h"
#include "exchange/mjcf_replicate.h"
#include "physics/world/body.h"
#include "scene/json_tree.h"

namespace careen {
namespace {

using SceneJson = nlohmann::ordered_json;

SceneJson arrayOf(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
SceneJson arrayOf(const Quat& q) { return {q.w(), q.x(), q.y(), q.z()}; }

// The x, y or z axis, if a direction is one of them within the rounding of the quaternion that says it.
Vec3 withoutRounding(Vec3 direction) {
  constexpr double kRounding = 1e-15;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (std::fabs(direction[axis]) > 1 - kRounding) {
      return std::copysign(1.0, direction[axis]) * Vec3::Unit(axis) + Vec3::Zero();  // no -0
    }
  }
  return direction;
}

class MjcfReader {
 public:
  MjcfReader(const std::string& text, const std::string& name) : document_(text, name) {}

  ImportedScene read() {
    scene_["careen"] = 1;
    const std::string model = document_.root().text("model");
    scene_["name"] = model.empty() ? "MuJoCo model" : model;
    scene_["duration"] = kImportedDuration;
    note("MJCF has no duration: " + brief(kImportedDuration) + " s");
    note("MJCF has no restitution: 0");
    replicate(document_);
    readSections();
    model_ = readModel(document_);
    if (!std::any_of(model_.surfaces.begin(), model_.surfaces.end(),
                     [](const auto& each) { return !each.isPlane(); })) {
      document_.fail(document_.root(), "no box in the model", "at least one");
    }
    const MjcfLinks links = readLinks(document_, model_);
    const MjcfContacts contacts = readContacts(document_, model_, filterParent_);
    if (contacts.isRefitted) {
      note("friction: coefficients for which each pair has that of MuJoCo, since scenes combine others");
    }
    writeSurfaces(contacts.frictions);
    writeJoints(document_, model_, links, contacts, kImportedDuration, scene_);
    writeDrag();
    notes_.insert(notes_.end(), model_.notes.begin(), model_.notes.end());
    noteIgnored();
    return {.text = sceneFile(), .notes = std::move(notes_)};
  }

 private:
  void note(const std::string& words) { notes_.push_back(words); }
  void noteIgnored() {
    std::string all;
    for (const std::string& each : document_.ignored()) {
      all += (all.empty() ? "ignored: " : ", ") + each;
    }
    if (!all.empty()) {
      note(all);
    }
  }

  // ---- Sections

  void readSections() {
    const std::set<std::string> read = {"compiler", "default", "worldbody", "tendon",  "contact",
                                        "keyframe", "asset",   "equality",  "actuator"};
    const std::set<std::string> ignored = {"visual", "statistic", "size", "custom", "sensor"};
    for (const XmlElement& section : document_.root().children) {
      if (section.name == "option") {
        readOption(section);
      } else if (ignored.contains(section.name)) {
        document_.ignore(section.name);
      } else if (!read.contains(section.name) && !section.children.empty()) {
        document_.fail(section.children[0], "<" + section.children[0].name + "> in <" + section.name + ">",
                       "boxes, planes and joints without it");
      } else if (!read.contains(section.name)) {
        document_.fail(section, "<" + section.name + ">", "boxes, planes and joints without it");
      }
    }
    scene_["gravity"] = arrayOf(hasGravity_ ? gravity_ : Vec3(Vec3::Zero()));
  }

  void readOption(const XmlElement& option) {
    document_.check(option, {"gravity", "density", "viscosity", "collision"},
                    {"timestep",
                     "apirate",
                     "impratio",
                     "wind",
                     "magnetic",
                     "o_margin",
                     "o_solref",
                     "o_solimp",
                     "o_friction",
                     "integrator",
                     "cone",
                     "jacobian",
                     "solver",
                     "iterations",
                     "tolerance",
                     "noslip_iterations",
                     "noslip_tolerance",
                     "mpr_iterations",
                     "mpr_tolerance",
                     "ls_iterations",
                     "ls_tolerance",
                     "ccd_iterations",
                     "ccd_tolerance",
                     "sdf_iterations",
                     "sdf_initpoints",
                     "sleep_tolerance",
                     "actuatorgroupdisable"});
    gravity_ = document_.vector(option, "gravity", gravity_);
    document_.mustBeZero(option, "density");
    document_.mustBeZero(option, "viscosity");
    if (const XmlAttribute* const collision = option.find("collision");
        collision && collision->value != "all") {
      document_.fail(option, *collision, "\"all\": boxes do not go through each other");
    }
    for (const XmlElement& flag : option.children) {
      for (const XmlAttribute& attribute : flag.attributes) {
        readFlag(flag, attribute);
      }
    }
  }

  void readFlag(const XmlElement& flag, const XmlAttribute& attribute) {
    const bool isOn = attribute.value == "enable";
    if (!isOn && attribute.value != "disable") {
      document_.fail(flag, attribute, "enable or disable");
    }
    if (attribute.name == "gravity") {
      hasGravity_ = isOn;
      return;
    }
    if (attribute.name == "filterparent") {
      filterParent_ = isOn ? FilterParent::kYes : FilterParent::kNo;
      return;
    }
    const std::set<std::string> changing = {"constraint", "contact",  "passive", "spring",
                                            "damper",     "equality", "limit",   "actuation"};
    if ((changing.contains(attribute.name) && !isOn) || (attribute.name == "override" && isOn)) {
      document_.fail(flag, attribute, "a flag that changes no motion");
    }
    document_.ignore("flag " + attribute.name);
  }

  // ---- The scene

  // One line for each key, box, wall and spring. What is no UTF-8 in a name becomes U+FFFD.
  std::string sceneFile() const {
    const auto dump = [](const SceneJson& json) {
      return json.dump(-1, ' ', false, SceneJson::error_handler_t::replace);
    };
    std::string text = "{";
    for (const auto& [key, value] : scene_.items()) {
      text += (text == "{" ? "\n  " : ",\n  ") + dump(key) + ": ";
      if (!value.is_array() || value.empty() || !value[0].is_object()) {
        text += dump(value);
        continue;
      }
      std::string items;
      for (const SceneJson& item : value) {
        items += (items.empty() ? "\n    " : ",\n    ") + dump(item);
      }
      text += "[" + items + "\n  ]";
    }
    return text + "\n}\n";
  }

  void writeSurfaces(const std::vector<double>& frictions) {
    SceneJson walls = SceneJson::array();
    SceneJson boxes = SceneJson::array();
    for (std::size_t i = 0; i < model_.surfaces.size(); ++i) {
      const MjcfSurface& each = model_.surfaces[i];
      SceneJson item = {{"name", each.name}};
      if (each.isPlane()) {
        item["point"] = arrayOf(each.frame.position);
        item["normal"] = arrayOf(withoutRounding(each.frame.turn * Vec3::UnitZ()));
      } else {
        writeBox(each, item);
      }
      item["friction"] = frictions[i];
      (each.isPlane() ? walls : boxes).push_back(item);
    }
    scene_["walls"] = walls;
    scene_["boxes"] = boxes;
    const auto end = [this](const MjcfSite& site) {
      return site.surface ? SceneJson({model_.surfaces[*site.surface].name, arrayOf(site.point)})
                          : arrayOf(site.point);
    };
    for (const MjcfSpring& spring : model_.springs) {
      scene_["springs"].push_back({{"from", end(spring.from)},
                                   {"to", end(spring.to)},
                                   {"stiffness", spring.stiffness},
                                   {"damping", spring.damping},
                                   {"rest_length", spring.restLength}});
    }
  }

  // None where a solid box, whose moments are given, has it.
  static void writeInertia(const Mat3& inertia, const Vec3& solid, SceneJson& item) {
    if (inertia != Mat3(inertia.diagonal().asDiagonal())) {
      item["inertia"] = {arrayOf(Vec3(inertia.row(0))), arrayOf(Vec3(inertia.row(1))),
                         arrayOf(Vec3(inertia.row(2)))};
    } else if (inertia.diagonal() != solid) {
      item["inertia"] = arrayOf(Vec3(inertia.diagonal()));
    }
  }

  static void writeParts(const std::vector<MjcfGeom>& parts, SceneJson& item) {
    for (const MjcfGeom& part : parts) {
      SceneJson one = {{"half_extents", arrayOf(Vec3(part.size.data()))}};
      one["position"] = arrayOf(part.position);
      if (part.turn.coeffs() != Quat::Identity().coeffs()) {
        one["orientation"] = arrayOf(part.turn);
      }
      item["parts"].push_back(one);
    }
  }

  // Scenes count what boxes share once, MuJoCo each box: mass, centre and inertia of several are written.
  static void writeBox(const MjcfSurface& box, SceneJson& item) {
    const Vec3 size(box.geom.size[0], box.geom.size[1], box.geom.size[2]);
    if (box.parts.empty()) {
      item["half_extents"] = arrayOf(size);
    } else {
      writeParts(box.parts, item);
    }
    if (box.movable) {
      item["mass"] = box.mass.mass;
      if (box.mass.inertia) {
        const bool isOne = box.parts.empty();
        writeInertia(*box.mass.inertia,
                     isOne ? solidBox(size, box.mass.mass).inertiaBody : Vec3(Vec3::Zero()), item);
      }
      if (!box.parts.empty() || !box.mass.center.isZero(0)) {
        item["center"] = arrayOf(box.mass.center);
      }
    } else {
      item["fixed"] = true;
    }
    item["position"] = arrayOf(box.frame.position);
    if (box.frame.turn.coeffs() != Quat::Identity().coeffs()) {
      item["orientation"] = arrayOf(box.frame.turn);
    }
    if (box.movable) {
      item["velocity"] = arrayOf(box.velocity);
      item["angular_velocity"] = arrayOf(box.angularVelocity);
    }
    if (box.geom.color) {
      std::string color = "#";
      for (const double channel : *box.geom.color) {
        const auto level = static_cast<unsigned>(std::lround(255 * std::clamp(channel, 0.0, 1.0)));
        color += {"0123456789abcdef"[level / 16], "0123456789abcdef"[level % 16]};
      }
      item["color"] = color;
    }
  }

  // Drag is one for all boxes, at their centres of mass; a free joint's acts on its own, at the body's
  // origin.
  void writeDrag() {
    const MjcfSurface* first = nullptr;
    for (const MjcfSurface& each : model_.surfaces) {
      if (!each.movable) {
        continue;
      }
      const auto dragOf = [](const MjcfSurface& box) { return box.isJointed() ? 0 : box.joint.damping; };
      first = first == nullptr ? &each : first;
      if (dragOf(each) != dragOf(*first)) {
        document_.fail(document_.root(),
                       "free joints of different damping, or bodies joined to one that has some",
                       "one damping for all");
      }
      const Vec3 center = each.geom.position + each.geom.turn * each.mass.center;
      if (dragOf(each) > 0 && center.norm() > kMjcfCentered * Vec3(each.geom.size.data()).norm()) {
        document_.fail(*each.joint.element, "damping of a body whose centre of mass is not its origin",
                       "a body about its centre of mass, or no damping");
      }
    }
    if (first != nullptr && first->joint.isFree() && first->joint.damping > 0) {
      scene_["drag"] = {{"linear", first->joint.damping}, {"angular", first->joint.damping}};
    }
  }

  MjcfDocument document_;
  MjcfModel model_;
  Vec3 gravity_ = Vec3(0, 0, -9.81);
  bool hasGravity_ = true;
  std::vector<std::string> notes_;
  SceneJson scene_ = SceneJson::object();
  FilterParent filterParent_ = FilterParent::kYes;
};

}  // namespace

ImportedScene importMjcf(const std::string& text, const std::string& name) {
  return MjcfReader(text, name).read();
}

}  // namespace careen
