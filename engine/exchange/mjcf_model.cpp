#include "exchange/mjcf_model.h"

#include <map>
#include <set>
#include <utility>

#include "exchange/mjcf_solid.h"
#include "scene/json_tree.h"
#include "scene/scene.h"

namespace careen {
namespace {

class ModelReader {
 public:
  explicit ModelReader(MjcfDocument& document) : document_(document), defaults_(document) {}

  MjcfModel read() {
    for (const XmlElement* const contacts : document_.sections("contact")) {
      for (const XmlElement& pair : contacts->children) {
        paired_.insert({pair.text("geom1"), pair.text("geom2")});
      }
    }
    for (const XmlElement* const world : document_.sections("worldbody")) {
      document_.check(*world, {});
      readFixed(contentsOf(document_, defaults_, *world, MjcfDefaults::kMain), {}, nullptr);
    }
    scaleMasses();
    for (const XmlElement* const tendons : document_.sections("tendon")) {
      readTendons(*tendons);
    }
    readStart();
    if (!renamed_.empty()) {
      model_.notes.push_back(renamed_);
    }
    return std::move(model_);
  }

 private:
  // ---- Bodies

  bool collides(const MjcfGeom& geom) const { return !geom.isVisual() || paired_.contains(geom.name); }

  // `body` is null for the world.
  void readFixed(const std::vector<MjcfContent>& contents, const MjcfFrame& frame, const XmlElement* body) {
    std::vector<MjcfGeom> geoms;
    const XmlElement* inertial = nullptr;
    for (const MjcfContent& content : contents) {
      const XmlElement& child = *content.element;
      if (child.name == "geom") {
        geoms.push_back(geomOf(defaults_, content));
        addFixed(geoms.back(), frame, body == nullptr ? std::string() : body->text("name"));
      } else if (child.name == "site") {
        addSite(content, frame, std::nullopt);
      } else if (child.name == "body") {
        readBody(content, frame, body == nullptr);
      } else if (child.name == "inertial" && body != nullptr) {
        inertial = &child;
      } else if (child.name == "light" || child.name == "camera") {
        document_.ignore(child.name);
      } else {
        document_.fail(child, "<" + child.name + "> in <" + (body == nullptr ? "worldbody" : "body") + ">",
                       "boxes and planes, fixed or with a free joint");
      }
    }
    if (body != nullptr && document_.compiler().totalMass > 0) {
      if (document_.compiler().fuseStatic) {
        document_.fail(*body, "a fixed body, which counts for settotalmass or not (fusestatic)",
                       "fusestatic=\"false\", or its geoms in <worldbody>");
      }
      fixedMass_ += fixedMassOf(document_, geoms, inertial);
    }
  }

  void addFixed(MjcfGeom geom, const MjcfFrame& frame, const std::string& body) {
    if (!collides(geom)) {
      document_.ignore("geom that collides with nothing");
      return;
    }
    const MjcfFrame placed = frame.of(geom.position, geom.turn);
    const bool isPlane = geom.type == "plane";
    if (!isPlane) {
      checkBox(geom);
    }
    const std::string given = geom.name.empty() && !isPlane ? body : geom.name;
    std::string name = uniqueName(given, isPlane ? "wall" : "box");
    model_.surfaces.push_back(
        {.geom = std::move(geom), .movable = false, .frame = placed, .name = std::move(name)});
  }

  void readBody(const MjcfContent& content, const MjcfFrame& parent, bool isTop) {
    const XmlElement& body = *content.element;
    document_.check(
        body,
        {"name", "childclass", "pos", "quat", "axisangle", "euler", "xyaxes", "zaxis", "mocap", "gravcomp"},
        {"user", "sleep"});
    document_.mustBeZero(body, "gravcomp");
    if (const XmlAttribute* const mocap = body.find("mocap"); mocap != nullptr && mocap->value != "false") {
      document_.fail(body, *mocap, "a body that nobody else moves");
    }
    const MjcfFrame frame = poseOf(document_, body, content.in(parent));
    const std::vector<MjcfContent> contents =
        contentsOf(document_, defaults_, body, defaults_.classOf(body, "childclass", content.ofClass));
    const XmlElement* joint = nullptr;
    for (const MjcfContent& each : contents) {
      const XmlElement& child = *each.element;
      if (child.name == "joint" || child.name == "freejoint") {
        const MjcfFreeJoint read = defaults_.joint(child, each.ofClass);
        if (!read.isFree || joint != nullptr) {
          document_.fail(child,
                         joint != nullptr ? "a second joint" : "a joint of type " + inQuotes(read.type),
                         "one free joint, or none");
        }
        if (!isTop) {
          document_.fail(child, "a free joint in a body in another", "it in <worldbody>");
        }
        joint = &child;
        model_.damping.push_back(read.damping);
      }
    }
    if (joint == nullptr) {
      readFixed(contents, frame, &body);
    } else {
      readFreeBody(body, contents, frame);
    }
  }

  void readFreeBody(const XmlElement& body, const std::vector<MjcfContent>& contents,
                    const MjcfFrame& frame) {
    const XmlElement* inertial = nullptr;
    std::vector<MjcfGeom> geoms;
    for (const MjcfContent& content : contents) {
      const XmlElement& child = *content.element;
      if (child.name == "geom") {
        geoms.push_back(geomOf(defaults_, content));
      } else if (child.name == "inertial") {
        inertial = &child;
      } else if (child.name == "light" || child.name == "camera") {
        document_.ignore(child.name);
      } else if (child.name != "joint" && child.name != "freejoint" && child.name != "site") {
        document_.fail(child, "<" + child.name + "> in a body that moves", "one box");
      }
    }
    const std::size_t box = boxOf(body, geoms);
    MjcfSurface surface{.geom = geoms[box],
                        .movable = true,
                        .frame = frame.of(geoms[box].position, geoms[box].turn),
                        .name = {},
                        .mass = massOf(document_, geoms, box, inertial),
                        .body = frame};
    for (const MjcfGeom& geom : geoms) {
      if (!surface.geom.color) {
        surface.geom.color = geom.color;
      }
    }
    surface.name = uniqueName(body.text("name").empty() ? surface.geom.name : body.text("name"), "box");
    const std::size_t index = model_.surfaces.size();
    model_.surfaces.push_back(std::move(surface));
    for (const MjcfContent& content : contents) {
      if (content.element->name == "site") {
        addSite(content, frame, index);
      }
    }
  }

  // That of its geoms which collides; if none does, its only box.
  std::size_t boxOf(const XmlElement& body, const std::vector<MjcfGeom>& geoms) {
    std::vector<std::size_t> colliding;
    std::vector<std::size_t> boxes;
    for (std::size_t i = 0; i < geoms.size(); ++i) {
      const MjcfGeom& geom = geoms[i];
      if (geom.type == "plane") {
        document_.fail(*geom.element, "a plane in a body that moves", "one box");
      }
      if (geom.type == "box") {
        boxes.push_back(i);
      }
      if (collides(geom)) {
        if (!colliding.empty()) {
          document_.fail(*geom.element, "a second <geom> in a body that moves",
                         "one box; others must collide with nothing (contype and conaffinity 0)");
        }
        colliding.push_back(i);
      }
    }
    const std::vector<std::size_t>& found = colliding.empty() ? boxes : colliding;
    if (found.size() != 1) {
      document_.fail(body,
                     geoms.empty() ? "a body that moves, without a <geom>"
                                   : "a body that moves, without a <geom> that collides",
                     "one box");
    }
    checkBox(geoms[found[0]]);
    if (geoms.size() > 1) {
      document_.ignore("geom that collides with nothing");
    }
    return found[0];
  }

  void checkBox(const MjcfGeom& geom) const {
    if (geom.type != "box") {
      const XmlAttribute* const type = geom.element->find("type");
      document_.tree().fail(type == nullptr ? geom.element->offset : type->offset,
                            "a <geom> of type " + inQuotes(geom.type), "type=\"box\" or type=\"plane\"");
    }
    checkSize(document_, geom, 3);
  }

  // settotalmass, of all bodies, those that do not move too.
  void scaleMasses() {
    if (document_.compiler().totalMass <= 0) {
      return;
    }
    double sum = fixedMass_;
    for (const MjcfSurface& surface : model_.surfaces) {
      sum += surface.movable ? surface.mass.mass : 0;
    }
    const double scale = document_.compiler().totalMass / sum;
    for (MjcfSurface& surface : model_.surfaces) {
      surface.mass.mass *= scale;
      if (surface.mass.inertia) {
        *surface.mass.inertia *= scale;
      }
    }
  }

  // Of a scene, boxes and walls share their names, some of which are those of a room; and tables have them.
  std::string uniqueName(const std::string& given, const std::string& kind) {
    std::string name = given.empty() ? kind + "-" + std::to_string(model_.surfaces.size()) : given;
    for (char& letter : name) {
      const auto code = static_cast<unsigned char>(letter);
      letter = letter == ',' || letter == '"' || code < 0x20 || code == 0x7f ? '_' : letter;
    }
    const std::string first = name;
    for (int number = 2; isRoomWall(name) || !names_.insert(name).second; ++number) {
      name = first + "-" + std::to_string(number);
    }
    if (!given.empty() && name != given) {
      renamed_ += (renamed_.empty() ? "renamed: " : ", ") + inQuotes(given) + " is " + inQuotes(name);
    }
    return name;
  }
  static bool isRoomWall(const std::string& name) {
    for (std::size_t side = 0; side < kRoomSides.size(); ++side) {
      if (name == roomWallName(side)) {
        return true;
      }
    }
    return false;
  }

  // ---- Springs

  void addSite(const MjcfContent& content, const MjcfFrame& frame, std::optional<std::size_t> box) {
    const XmlElement& element = *content.element;
    document_.check(element, {"name", "class", "pos", "fromto"},
                    {"type", "group", "material", "rgba", "size", "quat", "axisangle", "euler", "xyaxes",
                     "zaxis", "user"});
    MjcfSite site{.surface = box, .point = document_.vector(element, "pos", Vec3::Zero())};
    const std::vector<double> ends = document_.numbers(element, "fromto", 6, 6);
    if (!ends.empty() && !site.point.isZero(0)) {
      document_.fail(element, "pos and fromto for <site>", "one of them");
    }
    if (!ends.empty()) {
      site.point = 0.5 * Vec3(ends[0] + ends[3], ends[1] + ends[4], ends[2] + ends[5]);
    }
    if (content.frame) {
      site.point = content.frame->position + content.frame->turn * site.point;
    }
    site.place = frame.position + frame.turn * site.point;
    if (box) {
      const MjcfGeom& geom = model_.surfaces[*box].geom;
      site.point = geom.turn.conjugate() * Vec3(site.point - geom.position);
    } else {
      site.point = site.place;
    }
    sites_[element.text("name")] = site;
  }

  void readTendons(const XmlElement& tendons) {
    for (const XmlElement& tendon : tendons.children) {
      if (tendon.name != "spatial") {
        document_.fail(tendon, "<" + tendon.name + "> in <tendon>", "<spatial>");
      }
      document_.check(tendon, {"name", "stiffness", "damping", "springlength", "limited", "frictionloss"},
                      {"group", "width", "material", "rgba", "user", "margin", "solreflimit", "solimplimit",
                       "solreffriction", "solimpfriction"});
      document_.mustBeZero(tendon, "frictionloss");
      if (tendon.text("limited") == "true") {
        document_.fail(tendon, *tendon.find("limited"), "a tendon without limits");
      }
      std::vector<const MjcfSite*> ends;
      for (const XmlElement& end : tendon.children) {
        const auto site = end.name == "site" ? sites_.find(end.text("site")) : sites_.end();
        if (site == sites_.end()) {
          document_.fail(end, "<" + end.name + "> in <spatial>", "the <site> of a box or of the world");
        }
        ends.push_back(&site->second);
      }
      if (ends.size() != 2 || ends[0]->surface == ends[1]->surface) {
        document_.fail(tendon, std::to_string(ends.size()) + " sites of a tendon",
                       "2, of two bodies, or of a body and the world");
      }
      addSpring(tendon, *ends[0], *ends[1]);
    }
  }

  void addSpring(const XmlElement& tendon, const MjcfSite& from, const MjcfSite& to) {
    const auto positive = [&](const char* attribute, double whenAbsent) {
      const double value = document_.number(tendon, attribute, whenAbsent);
      if (value < 0) {
        document_.fail(tendon, *tendon.find(attribute), "a number not below 0");
      }
      return value;
    };
    double rest = document_.number(tendon, "springlength", -1);
    if (rest == -1) {
      rest = (to.place - from.place).norm();  // as the model stands
    } else if (rest < 0) {
      document_.fail(tendon, *tendon.find("springlength"), "-1, or a length [m]");
    }
    model_.springs.push_back({.from = from,
                              .to = to,
                              .stiffness = positive("stiffness", 0),
                              .damping = positive("damping", 0),
                              .restLength = rest});
  }

  // ---- The start

  // Of a free joint: position and quaternion; velocity in the world's frame, angular velocity in the body's.
  void readStart() {
    const std::size_t count = model_.damping.size();
    for (const XmlElement* const keys : document_.sections("keyframe")) {
      for (const XmlElement& key : keys->children) {
        if (key.text("name") != "start") {
          document_.ignore("key " + inQuotes(key.text("name")));
          continue;
        }
        document_.check(key, {"name", "qpos", "qvel"}, {"time"});
        const std::vector<double> places = document_.numbers(key, "qpos", 7 * count, 7 * count);
        const std::vector<double> speeds = document_.numbers(key, "qvel", 6 * count, 6 * count);
        std::size_t index = 0;
        for (MjcfSurface& surface : model_.surfaces) {
          if (surface.movable) {
            if (!places.empty()) {
              place(key, surface, places.data() + 7 * index);
            }
            if (!speeds.empty()) {
              const double* const v = speeds.data() + 6 * index;
              surface.angularVelocity = surface.body.turn * Vec3(v[3], v[4], v[5]);
              surface.velocity =
                  Vec3(v[0], v[1], v[2]) +
                  surface.angularVelocity.cross(Vec3(surface.body.turn * surface.geom.position));
            }
            ++index;
          }
        }
        model_.notes.emplace_back("starts from the key frame \"start\"");
      }
    }
  }

  void place(const XmlElement& key, MjcfSurface& surface, const double* q) const {
    const Quat turn(q[3], q[4], q[5], q[6]);
    if (turn.coeffs().cwiseAbs().maxCoeff() < 1e-14) {
      document_.fail(key, *key.find("qpos"), "quaternions that are not 0");
    }
    surface.body = {Vec3(q[0], q[1], q[2]), turn.normalized()};
    surface.frame = surface.body.of(surface.geom.position, surface.geom.turn);
  }

  MjcfDocument& document_;
  MjcfDefaults defaults_;
  MjcfModel model_;
  std::set<std::string> names_;
  std::string renamed_;
  std::set<std::string> paired_;  // geoms that a <pair> names
  double fixedMass_ = 0;          // [kg] of bodies that do not move
  std::map<std::string, MjcfSite> sites_;
};

}  // namespace

MjcfModel readModel(MjcfDocument& document) { return ModelReader(document).read(); }

}  // namespace careen
