#include "exchange/mjcf_model.h"

#include <array>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "exchange/mjcf_shape.h"
#include "exchange/mjcf_start.h"
#include "scene/json_tree.h"

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
    model_.bodies.emplace("world", MjcfNamedBody{});
    for (const XmlElement* const world : document_.sections("worldbody")) {
      document_.check(*world, {});
      readFixed(contentsOf(document_, defaults_, *world, MjcfDefaults::kMain), {}, nullptr);
    }
    model_.bodies.erase("");  // those without a name
    scaleMasses();
    findRods();
    for (const XmlElement* const tendons : document_.sections("tendon")) {
      readTendons(*tendons);
    }
    if (!rods_.empty()) {
      document_.fail(*rods_.begin()->second, inQuotes(rods_.begin()->first) + " for tendon1",
                     "the name of a tendon");
    }
    readStart(document_, model_);
    if (!names_.renamed().empty()) {
      model_.notes.push_back("renamed: " + names_.renamed());
    }
    if (!model_.jointNames.renamed().empty()) {
      model_.notes.push_back("renamed joints: " + model_.jointNames.renamed());
    }
    return std::move(model_);
  }

 private:
  // ---- Bodies

  bool collides(const MjcfGeom& geom) const { return !geom.isVisual() || paired_.contains(geom.name); }

  // `body` is null for the world.
  void readFixed(const std::vector<MjcfContent>& contents, const MjcfFrame& frame, const XmlElement* body) {
    std::vector<MjcfGeom> geoms;
    std::vector<std::size_t> boxes;
    std::vector<std::size_t> inIt;  // the first surfaces of bodies in it
    const XmlElement* inertial = nullptr;
    for (const MjcfContent& content : contents) {
      const XmlElement& child = *content.element;
      if (child.name == "geom") {
        geoms.push_back(geomOf(defaults_, content));
        if (geoms.back().type != "plane" && collides(geoms.back())) {
          boxes.push_back(model_.surfaces.size());
        }
        addFixed(geoms.back(), frame, body == nullptr ? "world" : body->text("name"));
      } else if (child.name == "site") {
        addSite(content, frame, std::nullopt);
      } else if (child.name == "body") {
        inIt.push_back(model_.surfaces.size());
        readBody(content, {.frame = frame, .isWorld = body == nullptr});
      } else if (child.name == "inertial" && body != nullptr) {
        inertial = &child;
      } else if (child.name == "light" || child.name == "camera") {
        document_.ignore(child.name);
      } else {
        document_.fail(child, "<" + child.name + "> in <" + (body == nullptr ? "worldbody" : "body") + ">",
                       "boxes and planes, fixed or with a joint");
      }
    }
    if (body != nullptr && !boxes.empty()) {
      model_.bodies[body->text("name")].surface = boxes[0];
    }
    for (const std::size_t each : inIt) {  // the world's boxes are not what its bodies are joined to
      if (body != nullptr && !boxes.empty() && each < model_.surfaces.size() &&
          model_.surfaces[each].isJointed() && !model_.surfaces[each].parent) {
        model_.surfaces[each].parent = boxes[0];
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
      checkBox(document_, geom);
    }
    const std::string given = geom.name.empty() && !isPlane && body != "world" ? body : geom.name;
    std::string name = uniqueName(given, isPlane ? "wall" : "box");
    model_.surfaces.push_back({.geom = std::move(geom),
                               .movable = false,
                               .frame = placed,
                               .name = std::move(name),
                               .ofBody = body});
  }

  /// The body, or the world, that others are in.
  struct Parent {
    MjcfFrame frame;                      // world from it
    std::optional<std::size_t> box = {};  // if it moves
    bool isWorld = false;
  };

  void readBody(const MjcfContent& content, const Parent& parent) {
    const XmlElement& body = *content.element;
    document_.check(
        body,
        {"name", "childclass", "pos", "quat", "axisangle", "euler", "xyaxes", "zaxis", "mocap", "gravcomp"},
        {"user", "sleep"});
    document_.mustBeZero(body, "gravcomp");
    if (const XmlAttribute* const mocap = body.find("mocap"); mocap != nullptr && mocap->value != "false") {
      document_.fail(body, *mocap, "a body that nobody else moves");
    }
    const MjcfFrame frame = poseOf(document_, body, content.in(parent.frame));
    const std::vector<MjcfContent> contents =
        contentsOf(document_, defaults_, body, defaults_.classOf(body, "childclass", content.ofClass));
    const std::optional<MjcfJoint> joint = jointOf(contents, parent.isWorld);
    if (!joint && !parent.box) {
      model_.bodies.insert_or_assign(body.text("name"), MjcfNamedBody{.standing = frame});
      readFixed(contents, frame, &body);
      return;
    }
    MjcfSurface surface{.geom = {},
                        .movable = true,
                        .frame = {},
                        .name = {},
                        .ofBody = body.text("name"),
                        .body = frame,
                        .standing = frame,
                        .parent = parent.box,
                        .inParent = parent.box ? poseOf(document_, body, content.in({})) : frame,
                        .joint = joint.value_or(MjcfJoint{.element = &body, .name = {}, .type = "fixed"})};
    readMovable(body, contents, std::move(surface));
  }

  std::optional<MjcfJoint> jointOf(const std::vector<MjcfContent>& contents, bool isTop) const {
    std::optional<MjcfJoint> joint;
    for (const MjcfContent& each : contents) {
      const XmlElement& child = *each.element;
      if (child.name != "joint" && child.name != "freejoint") {
        continue;
      }
      if (joint) {
        document_.fail(child, "a second joint", "one, or none");
      }
      joint = defaults_.joint(child, each.ofClass);
      if (joint->isFree() && !isTop) {
        document_.fail(child, "a free joint in a body in another", "it in <worldbody>");
      }
      if (each.frame) {
        joint->position = each.frame->position + each.frame->turn * joint->position;
        joint->axis = each.frame->turn * joint->axis;
      }
      if (!MjcfDocument::turnToZ(joint->axis)) {
        document_.fail(child, "a joint with an axis of length 0", "a direction");
      }
      joint->axis = joint->axis.stableNormalized();
    }
    return joint;
  }

  void readMovable(const XmlElement& body, const std::vector<MjcfContent>& contents, MjcfSurface surface) {
    const MjcfFrame frame = surface.body;
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
      } else if (child.name != "joint" && child.name != "freejoint" && child.name != "site" &&
                 child.name != "body") {
        document_.fail(child, "<" + child.name + "> in a body that moves", "boxes");
      }
    }
    MjcfShape shape =
        shapeOf(document_, body, geoms, [this](const MjcfGeom& geom) { return collides(geom); });
    surface.frame = frame.of(shape.geom.position, shape.geom.turn);
    surface.mass = massOf(document_, geoms, shape, inertial);
    surface.geom = std::move(shape.geom);
    surface.parts = std::move(shape.parts);
    surface.name = uniqueName(body.text("name").empty() ? surface.geom.name : body.text("name"), "box");
    if (surface.isJointed()) {
      surface.joint.name = model_.jointNames.unique(surface.joint.name, surface.name);
    }
    const std::size_t index = model_.surfaces.size();
    model_.bodies.insert_or_assign(body.text("name"), MjcfNamedBody{.surface = index, .standing = frame});
    model_.surfaces.push_back(std::move(surface));
    for (const MjcfContent& content : contents) {
      if (content.element->name == "site") {
        addSite(content, frame, index);
      } else if (content.element->name == "body") {
        readBody(content, {.frame = frame, .box = index});
      }
    }
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

  // Of a scene, boxes and walls share their names.
  std::string uniqueName(const std::string& given, const std::string& kind) {
    return names_.unique(given, kind + "-" + std::to_string(model_.surfaces.size()));
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
      document_.check(tendon,
                      {"name", "stiffness", "damping", "springlength", "limited", "range", "frictionloss"},
                      {"group", "width", "material", "rgba", "user", "margin", "solreflimit", "solimplimit",
                       "solreffriction", "solimpfriction"});
      document_.mustBeZero(tendon, "frictionloss");
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
      const bool isHeld = addRopes(tendon, *ends[0], *ends[1]);
      addSpring(tendon, *ends[0], *ends[1], isHeld);
    }
  }

  // What <equality> holds at the length it has.
  void findRods() {
    for (const XmlElement* const equalities : document_.sections("equality")) {
      for (const XmlElement& each : equalities->children) {
        if (each.name == "tendon" && each.text("active") != "false") {
          document_.check(each, {"name", "class", "active", "tendon1", "polycoef"}, {"solref", "solimp"});
          const std::vector<double> coefficients = document_.numbers(each, "polycoef", 1, 5);
          if (!coefficients.empty() && coefficients[0] != 0) {
            document_.fail(each, *each.find("polycoef"), "0 as the first: the length that the tendon has");
          }
          rods_[each.text("tendon1")] = &each;
        }
      }
    }
  }

  // Whether it is one.
  bool addRopes(const XmlElement& tendon, const MjcfSite& from, const MjcfSite& to) {
    const std::vector<double> given = document_.numbers(tendon, "range", 2, 2);
    const std::array<double, 2> range = given.empty() ? std::array{0.0, 0.0} : std::array{given[0], given[1]};
    const std::string name = tendon.text("name");
    const bool isRope = document_.isLimited(
        tendon, document_.word(tendon, "limited", {"false", "true", "auto"}, "auto"), range);
    if (isRope && range[0] > 0) {
      document_.fail(tendon, *tendon.find("range"), "0 as the least length: a rope may be slack");
    }
    const auto add = [&](const XmlElement& element, double length) {
      model_.ropes.push_back(
          {.element = &element,
           .name = model_.jointNames.unique(name, "rope-" + std::to_string(model_.ropes.size())),
           .isRod = &element != &tendon,
           .from = from,
           .to = to,
           .length = length});
    };
    if (isRope) {
      add(tendon, range[1]);
    }
    const auto rod = name.empty() ? rods_.end() : rods_.find(name);
    const bool isRod = rod != rods_.end();
    if (isRod) {
      add(*rod->second, (to.place - from.place).norm());
      rods_.erase(rod);
    }
    return isRope || isRod;
  }

  // None where there is no force beside that of a rope.
  void addSpring(const XmlElement& tendon, const MjcfSite& from, const MjcfSite& to, bool isHeld) {
    const double stiffness = document_.positive(tendon, "stiffness", 0);
    const double damping = document_.positive(tendon, "damping", 0);
    double rest = document_.number(tendon, "springlength", -1);
    if (rest == -1) {
      rest = (to.place - from.place).norm();  // as the model stands
    } else if (rest < 0) {
      document_.fail(tendon, *tendon.find("springlength"), "-1, or a length [m]");
    }
    if (!isHeld || stiffness > 0 || damping > 0) {
      model_.springs.push_back(
          {.from = from, .to = to, .stiffness = stiffness, .damping = damping, .restLength = rest});
    }
  }

  MjcfDocument& document_;
  MjcfDefaults defaults_;
  MjcfModel model_;
  MjcfNames names_;
  std::map<std::string, const XmlElement*> rods_;  // <equality> by tendon
  std::set<std::string> paired_;                   // geoms that a <pair> names
  double fixedMass_ = 0;                           // [kg] of bodies that do not move
  std::map<std::string, MjcfSite> sites_;
};

}  // namespace

Vec3 MjcfModel::placeOf(const MjcfSite& site) const {
  if (!site.surface) {
    return site.point;
  }
  const MjcfFrame& box = surfaces[*site.surface].frame;
  return box.position + box.turn * site.point;
}

MjcfModel readModel(MjcfDocument& document) { return ModelReader(document).read(); }

}  // namespace careen
