#include "exchange/mjcf_links.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "scene/json_tree.h"

namespace careen {
namespace {

class LinkReader {
 public:
  LinkReader(MjcfDocument& document, MjcfModel& model) : document_(document), model_(model) {
    for (std::size_t i = 0; i < model_.surfaces.size(); ++i) {
      const MjcfSurface& surface = model_.surfaces[i];
      if (surface.movable && surface.joint.hasCoordinate()) {
        joints_[surface.joint.element->text("name")] = i;
      }
    }
  }

  MjcfLinks read() {
    for (const XmlElement* const equalities : document_.sections("equality")) {
      for (const XmlElement& each : equalities->children) {
        if (each.text("active") == "false") {
          document_.ignore(each.name + " that is not active");
        } else if (each.name == "connect" || each.name == "weld") {
          readClosing(each);
        } else if (each.name != "tendon") {
          document_.fail(each, "<" + each.name + "> in <equality>", "<connect>, <weld> or <tendon>");
        }
      }
    }
    for (const XmlElement* const option : document_.sections("option")) {
      links_.timestep = document_.number(*option, "timestep", links_.timestep);
    }
    readControls();
    return std::move(links_);
  }

 private:
  // ---- <equality>

  const MjcfNamedBody& bodyOf(const XmlElement& element, const char* attribute) const {
    const XmlAttribute* const given = element.find(attribute);
    const auto found = model_.bodies.find(given == nullptr ? "world" : given->value);
    if (found == model_.bodies.end()) {
      document_.fail(element, *given, "the name of a <body>");
    }
    return found->second;
  }
  MjcfFrame frameOf(const MjcfNamedBody& body) const {
    return moves(body) ? model_.surfaces[*body.surface].body : body.standing;
  }
  bool moves(const MjcfNamedBody& body) const {
    return body.surface && model_.surfaces[*body.surface].movable;
  }

  void readClosing(const XmlElement& element) {
    const bool isWeld = element.name == "weld";
    if (isWeld) {
      document_.check(element, {"name", "class", "active", "body1", "body2", "relpose", "anchor"},
                      {"solref", "solimp", "torquescale"});
      const std::vector<double> pose = document_.numbers(element, "relpose", 7, 7);
      if (!pose.empty() && std::any_of(pose.begin() + 3, pose.end(), [](double each) { return each != 0; })) {
        document_.fail(element, *element.find("relpose"), "none: the pose that the model has as it stands");
      }
    } else {
      document_.check(element, {"name", "class", "active", "body1", "body2", "anchor"}, {"solref", "solimp"});
    }
    const MjcfNamedBody& one = bodyOf(element, "body1");
    const MjcfNamedBody& two = bodyOf(element, "body2");
    if (!moves(one) && !moves(two)) {
      document_.ignore(element.name + " of what does not move");
      return;
    }
    if (one.surface == two.surface) {
      document_.fail(element, "<" + element.name + "> of one body", "two");
    }
    // As the model stands, the anchor is in both.
    const MjcfFrame here = frameOf(one);
    const Vec3 anchor = isWeld ? Vec3(Vec3::Zero()) : document_.vector(element, "anchor", Vec3::Zero());
    const Vec3 at = here.position + here.turn * anchor;
    const MjcfFrame relative = seenFrom(two.standing, one.standing);
    const MjcfFrame wanted = frameOf(two).of(relative.position + relative.turn * anchor, relative.turn);
    const double size = sizeOf(moves(one) ? one : two);
    const double off =
        (at - wanted.position).norm() + (isWeld ? size * here.turn.angularDistance(wanted.turn) : 0);
    if (!(off <= kMjcfCentered * size)) {
      document_.fail(element, "<" + element.name + "> that the key frame \"start\" leaves open",
                     "one that holds");
    }
    const bool isFirst = moves(one);
    links_.closings.push_back(
        {.isFixed = isWeld,
         .name = model_.jointNames.unique(element.text("name"),
                                          element.name + "-" + std::to_string(links_.closings.size())),
         .from = *(isFirst ? one : two).surface,
         .to = (isFirst ? two : one).surface,
         .at = at});
  }
  static MjcfFrame seenFrom(const MjcfFrame& from, const MjcfFrame& frame) {
    const Quat back = from.turn.conjugate();
    return {back * Vec3(frame.position - from.position), (back * frame.turn).normalized()};
  }
  double sizeOf(const MjcfNamedBody& body) const {
    const std::vector<double>& size = model_.surfaces[*body.surface].geom.size;
    return Vec3(size[0], size[1], size[2]).norm();
  }

  // ---- <actuator>

  void readControls() {
    std::size_t count = 0;
    for (const XmlElement* const actuators : document_.sections("actuator")) {
      count += actuators->children.size();
    }
    std::vector<double> controls;
    for (const XmlElement* const keys : document_.sections("keyframe")) {
      for (const XmlElement& key : keys->children) {
        if (key.text("name") == "start") {
          controls = document_.numbers(key, "ctrl", count, count);
        }
      }
    }
    controls.resize(count, 0);
    std::size_t index = 0;
    for (const XmlElement* const actuators : document_.sections("actuator")) {
      for (const XmlElement& actuator : actuators->children) {
        readActuator(actuator, controls[index++]);
      }
    }
  }

  void readActuator(const XmlElement& actuator, double control) {
    const bool isPosition = actuator.name == "position";
    const bool isVelocity = actuator.name == "velocity";
    if (!isPosition && !isVelocity && actuator.name != "motor") {
      document_.fail(actuator, "<" + actuator.name + "> in <actuator>", "<motor>, <position> or <velocity>");
    }
    document_.check(actuator,
                    {"name", "class", "joint", "gear", "ctrlrange", "ctrllimited", "forcerange",
                     "forcelimited", "kp", "kv"},
                    {"group", "user", "lengthrange"});
    const auto joint = joints_.find(actuator.text("joint"));
    if (joint == joints_.end() || !model_.surfaces[joint->second].joint.hasCoordinate()) {
      const XmlAttribute* const given = actuator.find("joint");
      document_.tree().fail(given == nullptr ? actuator.offset : given->offset,
                            inQuotes(actuator.text("joint")) + " for joint", "the name of a hinge or slide");
    }
    const std::vector<double> gears = document_.numbers(actuator, "gear", 1, 6);
    const double gear = gears.empty() ? 1 : gears[0];
    const auto [least, most] = limitsOf(actuator, "ctrlrange", "ctrllimited");
    const double wanted = least < most ? std::clamp(control, least, most) : control;
    const double gain = isPosition   ? document_.positive(actuator, "kp", 1)
                        : isVelocity ? document_.positive(actuator, "kv", 1)
                                     : 0;
    const double damping = isPosition ? document_.positive(actuator, "kv", 0) : 0;
    const bool isIdle = gear == 0 || (gain == 0 && damping == 0);
    if (wanted != 0 && !isPosition) {
      document_.fail(actuator, "<" + actuator.name + "> with a control that is not 0", "<position>, or 0");
    }
    if (isIdle) {
      document_.ignore(actuator.name + " that nobody drives");
      return;
    }
    const auto [pull, push] = limitsOf(actuator, "forcerange", "forcelimited");
    if (pull != -push) {
      document_.fail(actuator, *actuator.find("forcerange"), "the same bound both ways");
    }
    links_.motors.push_back({.surface = joint->second,
                             .kp = isPosition ? gain * gear * gear : 0,
                             .kd = (isPosition ? damping : gain) * gear * gear,
                             .target = wanted / gear,
                             .largest = push * std::fabs(gear)});
  }

  // 0 and 0 if there are none.
  std::array<double, 2> limitsOf(const XmlElement& actuator, const char* range, const char* limited) const {
    const std::vector<double> given = document_.numbers(actuator, range, 2, 2);
    const std::string word = document_.word(actuator, limited, {"false", "true", "auto"}, "auto");
    const std::array<double, 2> ends = given.empty() ? std::array{0.0, 0.0} : std::array{given[0], given[1]};
    return document_.isLimited(actuator, word, ends) ? ends : std::array{0.0, 0.0};
  }

  MjcfDocument& document_;
  MjcfModel& model_;
  MjcfLinks links_;
  std::map<std::string, std::size_t> joints_;  // surfaces, by the name in the file
};

}  // namespace

MjcfLinks readLinks(MjcfDocument& document, MjcfModel& model) { return LinkReader(document, model).read(); }

}  // namespace careen
