#include "exchange/import_mjcf.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "core/brief.h"
#include "core/math/linear_algebra.h"
#include "exchange/friction_fit.h"
#include "exchange/mjcf_document.h"
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
    readContacts();
    writeSurfaces();
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
    const std::set<std::string> read = {"compiler", "default",  "worldbody", "tendon",
                                        "contact",  "keyframe", "asset"};
    const std::set<std::string> ignored = {"visual", "statistic", "size", "custom", "sensor"};
    for (const XmlElement& section : document_.root().children) {
      if (section.name == "option") {
        readOption(section);
      } else if (ignored.contains(section.name)) {
        document_.ignore(section.name);
      } else if (!read.contains(section.name) && !section.children.empty()) {
        document_.fail(section.children[0], "<" + section.children[0].name + "> in <" + section.name + ">",
                       "boxes and planes without it");
      } else if (!read.contains(section.name)) {
        document_.fail(section, "<" + section.name + ">", "boxes and planes without it");
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
    const std::set<std::string> changing = {"constraint", "contact", "passive", "spring", "damper"};
    if ((changing.contains(attribute.name) && !isOn) || (attribute.name == "override" && isOn)) {
      document_.fail(flag, attribute, "a flag that changes no motion");
    }
    document_.ignore("flag " + attribute.name);
  }

  // ---- Friction

  void readContacts() {
    std::map<std::string, std::size_t> byGeom;
    for (std::size_t i = 0; i < model_.surfaces.size(); ++i) {
      if (!model_.surfaces[i].geom.name.empty()) {
        byGeom.emplace(model_.surfaces[i].geom.name, i);
      }
    }
    for (const XmlElement* const contacts : document_.sections("contact")) {
      for (const XmlElement& pair : contacts->children) {
        if (pair.name != "pair") {
          document_.fail(pair, "<" + pair.name + "> in <contact>", "boxes that do not go through each other");
        }
        document_.check(pair, {"name", "geom1", "geom2", "condim", "friction"},
                        {"solref", "solreffriction", "solimp", "margin", "gap"});
        std::size_t ends[2] = {0, 0};
        for (const int k : {0, 1}) {
          const char* const attribute = k == 0 ? "geom1" : "geom2";
          const auto found = byGeom.find(pair.text(attribute));
          if (found == byGeom.end()) {
            document_.fail(pair, inQuotes(pair.text(attribute)) + " for " + attribute,
                           "the name of a <geom>");
          }
          ends[k] = found->second;
        }
        const std::vector<double> friction = document_.numbers(pair, "friction", 1, 5);
        const double usual = ownFriction(ends[0], ends[1]);
        const double sliding = friction.empty() ? usual : friction[0];
        if (sliding < 0 || (friction.size() > 1 && friction[1] != sliding)) {
          document_.fail(pair, *pair.find("friction"), "the same friction in all directions, not below 0");
        }
        const int most = std::max(model_.surfaces[ends[0]].geom.condim, model_.surfaces[ends[1]].geom.condim);
        pairs_[std::minmax(ends[0], ends[1])] = document_.integer(pair, "condim", most) == 1 ? 0 : sliding;
      }
    }
    fitFriction();
  }

  double ownFriction(std::size_t i, std::size_t j) const {
    const MjcfGeom& a = model_.surfaces[i].geom;
    const MjcfGeom& b = model_.surfaces[j].geom;
    if (a.priority != b.priority) {
      const MjcfGeom& counts = a.priority > b.priority ? a : b;
      return counts.condim == 1 ? 0 : counts.friction;
    }
    return std::max(a.condim, b.condim) == 1 ? 0 : std::max(a.friction, b.friction);
  }

  void fitFriction() {
    const auto likeFirst = [this](const MjcfSurface& each) {
      const MjcfGeom& one = model_.surfaces[0].geom;
      const MjcfGeom& other = each.geom;
      return one.friction == other.friction && one.condim == other.condim && one.priority == other.priority &&
             other.contype == 1 && other.conaffinity == 1;
    };
    std::vector<double> own;
    std::vector<bool> movable;
    for (const MjcfSurface& each : model_.surfaces) {
      own.push_back(each.geom.condim == 1 ? 0 : each.geom.friction);
      movable.push_back(each.movable);
    }
    frictions_ = own;
    if (pairs_.empty() && std::all_of(model_.surfaces.begin(), model_.surfaces.end(), likeFirst)) {
      return;
    }
    const std::size_t moving = model_.damping.size();
    if (moving * model_.surfaces.size() > kMostImportedPairs) {
      document_.fail(
          document_.root(),
          "geoms of different friction in more than " + std::to_string(kMostImportedPairs) + " pairs",
          "fewer, or one friction for all");
    }
    checkCollisions();
    const FrictionFit fit = fitFrictions(own, movable, [this](std::size_t i, std::size_t j) {
      const auto pair = pairs_.find(std::minmax(i, j));
      return pair == pairs_.end() ? ownFriction(i, j) : pair->second;
    });
    if (fit.misfit) {
      const MjcfSurface& a = model_.surfaces[fit.misfit->first];
      const MjcfSurface& b = model_.surfaces[fit.misfit->second];
      document_.fail(*b.geom.element,
                     "frictions of pairs, as of " + inQuotes(a.name) + " and " + inQuotes(b.name) +
                         ", that no coefficients of the boxes and walls give",
                     "those of a scene: the friction of each pair is sqrt(μ₁ μ₂)");
    }
    if (fit.coefficients != own) {
      note("friction: coefficients for which each pair has that of MuJoCo, since scenes combine others");
    }
    frictions_ = fit.coefficients;
  }

  // A pair that is named collides whatever its bits are.
  void checkCollisions() const {
    for (std::size_t i = 0; i < model_.surfaces.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const auto bits = [](int value) { return static_cast<unsigned>(value); };
        const MjcfGeom& a = model_.surfaces[i].geom;
        const MjcfGeom& b = model_.surfaces[j].geom;
        const bool collide =
            ((bits(a.contype) & bits(b.conaffinity)) | (bits(b.contype) & bits(a.conaffinity))) != 0;
        if ((model_.surfaces[i].movable || model_.surfaces[j].movable) && !collide &&
            !pairs_.contains({j, i})) {
          document_.fail(*a.element,
                         inQuotes(model_.surfaces[i].name) + ", which goes through " +
                             inQuotes(model_.surfaces[j].name) + " (contype, conaffinity)",
                         "boxes that do not go through each other");
        }
      }
    }
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

  void writeSurfaces() {
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
      item["friction"] = frictions_[i];
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

  // None where a solid box has it.
  static void writeInertia(const Mat3& inertia, const Vec3& solid, SceneJson& item) {
    if (inertia != Mat3(inertia.diagonal().asDiagonal())) {
      item["inertia"] = {arrayOf(Vec3(inertia.row(0))), arrayOf(Vec3(inertia.row(1))),
                         arrayOf(Vec3(inertia.row(2)))};
    } else if (inertia.diagonal() != solid) {
      item["inertia"] = arrayOf(Vec3(inertia.diagonal()));
    }
  }

  static void writeBox(const MjcfSurface& box, SceneJson& item) {
    const Vec3 size(box.geom.size[0], box.geom.size[1], box.geom.size[2]);
    item["half_extents"] = arrayOf(size);
    if (box.movable) {
      item["mass"] = box.mass.mass;
      if (box.mass.inertia) {
        writeInertia(*box.mass.inertia, solidBox(size, box.mass.mass).inertiaBody, item);
      }
      if (!box.mass.center.isZero(0)) {
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

  // Drag is one for all boxes.
  void writeDrag() {
    const double damping = model_.damping.empty() ? 0 : model_.damping[0];
    if (std::any_of(model_.damping.begin(), model_.damping.end(),
                    [&](double each) { return each != damping; })) {
      document_.fail(document_.root(), "free joints of different damping", "one damping for all");
    }
    if (damping > 0) {
      scene_["drag"] = {{"linear", damping}, {"angular", damping}};
    }
  }

  MjcfDocument document_;
  MjcfModel model_;
  Vec3 gravity_ = Vec3(0, 0, -9.81);
  bool hasGravity_ = true;
  std::vector<std::string> notes_;
  SceneJson scene_ = SceneJson::object();
  std::vector<double> frictions_;
  std::map<std::pair<std::size_t, std::size_t>, double> pairs_;  // friction, of surfaces in order
};

}  // namespace

ImportedScene importMjcf(const std::string& text, const std::string& name) {
  return MjcfReader(text, name).read();
}

}  // namespace careen
