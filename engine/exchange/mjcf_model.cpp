#include "exchange/mjcf_model.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "scene/json_shape.h"
#include "scene/json_tree.h"
#include "scene/scene.h"

namespace careen {
namespace {

class ModelReader {
 public:
  explicit ModelReader(MjcfDocument& document) : document_(document), defaults_(document) {}

  MjcfModel read() {
    for (const XmlElement* const world : document_.sections("worldbody")) {
      document_.check(*world, {});
      readBodies(*world, {}, MjcfDefaults::kMain);
    }
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

  void readBodies(const XmlElement& parent, const MjcfFrame& frame, const std::string& ofBody) {
    for (const XmlElement& child : parent.children) {
      if (child.name == "geom") {
        addStatic(defaults_.geom(child, ofBody), frame, parent.text("name"));
      } else if (child.name == "site") {
        addSite(child, frame, std::nullopt);
      } else if (child.name == "body") {
        readBody(child, frame, ofBody, parent.name == "worldbody");
      } else if (child.name == "light" || child.name == "camera") {
        document_.ignore(child.name);
      } else if (child.name != "inertial") {
        document_.fail(child, "<" + child.name + "> in <" + parent.name + ">",
                       "boxes and planes, fixed or with a free joint");
      }
    }
  }

  void readBody(const XmlElement& body, const MjcfFrame& parent, const std::string& ofBody, bool isTop) {
    document_.check(
        body,
        {"name", "childclass", "pos", "quat", "axisangle", "euler", "xyaxes", "zaxis", "mocap", "gravcomp"},
        {"user"});
    document_.mustBeZero(body, "gravcomp");
    if (const XmlAttribute* const mocap = body.find("mocap"); mocap != nullptr && mocap->value != "false") {
      document_.fail(body, *mocap, "a body that nobody else moves");
    }
    const MjcfFrame frame =
        parent.of(document_.vector(body, "pos", Vec3::Zero()), document_.orientation(body, Quat::Identity()));
    const std::string childClass = defaults_.classOf(body, "childclass", ofBody);
    const XmlElement* joint = nullptr;
    for (const XmlElement& child : body.children) {
      if (child.name == "joint" || child.name == "freejoint") {
        const MjcfFreeJoint read = defaults_.joint(child, childClass);
        if (!read.isFree || joint != nullptr) {
          document_.fail(child,
                         joint != nullptr ? "a second joint" : "a joint of type " + inQuotes(read.type),
                         "one free joint, or none");
        }
        if (!isTop) {
          document_.fail(child, "a free joint in a body in another", "bodies in <worldbody>");
        }
        joint = &child;
        model_.damping.push_back(read.damping);
      }
    }
    if (joint == nullptr) {
      readBodies(body, frame, childClass);
    } else {
      readFreeBody(body, frame, childClass);
    }
  }

  void readFreeBody(const XmlElement& body, const MjcfFrame& frame, const std::string& ofBody) {
    const XmlElement* inertial = nullptr;
    std::optional<std::size_t> box;
    for (const XmlElement& child : body.children) {
      if (child.name == "geom") {
        MjcfGeom geom = defaults_.geom(child, ofBody);
        if (box || geom.type != "box") {
          document_.fail(child, box ? "a second <geom> in a body that moves" : "a plane in a body that moves",
                         "one box");
        }
        box = model_.surfaces.size();
        checkSize(geom);
        const MjcfFrame placed = frame.of(geom.position, geom.turn);
        model_.surfaces.push_back({.geom = std::move(geom), .movable = true, .frame = placed, .name = {}});
      } else if (child.name == "inertial") {
        inertial = &child;
      } else if (child.name == "light" || child.name == "camera") {
        document_.ignore(child.name);
      } else if (child.name != "joint" && child.name != "freejoint" && child.name != "site") {
        document_.fail(child, "<" + child.name + "> in a body that moves", "one box");
      }
    }
    if (!box) {
      document_.fail(body, "a body that moves, without a <geom>", "one box");
    }
    MjcfSurface& surface = model_.surfaces[*box];
    surface.body = frame;
    surface.mass = massOf(document_, surface.geom, inertial);
    surface.name = uniqueName(body.text("name").empty() ? surface.geom.name : body.text("name"), "box");
    for (const XmlElement& child : body.children) {
      if (child.name == "site") {
        addSite(child, frame, box);
      }
    }
  }

  void checkSize(const MjcfGeom& geom) const {
    const bool good =
        geom.size.size() == 3 && std::all_of(geom.size.begin(), geom.size.end(),
                                             [](double each) { return each >= kSmallestPositive; });
    if (!good) {
      const XmlAttribute* const size = geom.element->find("size");
      document_.tree().fail(size == nullptr ? geom.element->offset : size->offset,
                            std::to_string(geom.size.size()) + " numbers for the size of a box",
                            "3 half extents above 0 [m]");
    }
  }

  void addStatic(MjcfGeom geom, const MjcfFrame& frame, const std::string& body) {
    const MjcfFrame placed = frame.of(geom.position, geom.turn);
    const bool isPlane = geom.type == "plane";
    if (!isPlane) {
      checkSize(geom);
    }
    const std::string given = geom.name.empty() && !isPlane ? body : geom.name;
    std::string name = uniqueName(given, isPlane ? "wall" : "box");
    model_.surfaces.push_back(
        {.geom = std::move(geom), .movable = false, .frame = placed, .name = std::move(name)});
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

  void addSite(const XmlElement& element, const MjcfFrame& frame, std::optional<std::size_t> box) {
    document_.check(element, {"name", "class", "pos"},
                    {"type", "group", "material", "rgba", "size", "fromto", "quat", "axisangle", "euler",
                     "xyaxes", "zaxis", "user"});
    MjcfSite site{.surface = box, .point = document_.vector(element, "pos", Vec3::Zero())};
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
  std::map<std::string, MjcfSite> sites_;
};

}  // namespace

MjcfModel readModel(MjcfDocument& document) { return ModelReader(document).read(); }

}  // namespace careen
