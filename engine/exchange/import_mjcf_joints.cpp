#include "exchange/import_mjcf_joints.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "core/brief.h"

namespace careen {
namespace {

using JointJson = nlohmann::ordered_json;

JointJson coordinatesOf(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

class JointWriter {
 public:
  JointWriter(const MjcfDocument& document, const MjcfModel& model, const MjcfContacts& contacts)
      : document_(document), model_(model), contacts_(contacts) {}

  JointJson write(const MjcfLinks& links) {
    for (std::size_t i = 0; i < model_.surfaces.size(); ++i) {
      if (model_.surfaces[i].isJointed()) {
        addJoint(i);
      }
    }
    for (const MjcfClosing& each : links.closings) {
      JointJson item = begin(each.name, each.isFixed ? "fixed" : "ball", each.from, each.to);
      item["at"] = coordinatesOf(each.at);
      joints_.push_back(item);
    }
    for (const MjcfRope& each : model_.ropes) {
      addRope(each);
    }
    return joints_;
  }

  // Joined boxes that collide say so, others that do not are listed.
  JointJson passThrough() const {
    JointJson lists = JointJson::array();
    for (const auto& pair : contacts_.apart) {
      if (!joined_.contains(pair)) {
        lists.push_back({nameOf(pair.first), nameOf(pair.second)});
      }
    }
    return lists;
  }

 private:
  JointJson nameOf(const std::optional<std::size_t>& surface) const {
    return surface ? model_.surfaces[*surface].name : "world";
  }

  JointJson begin(const std::string& name, const std::string& type, const std::optional<std::size_t>& from,
                  const std::optional<std::size_t>& to) {
    JointJson item = {{"name", name}, {"type", type}, {"between", {nameOf(from), nameOf(to)}}};
    if (from && to) {
      const std::pair<std::size_t, std::size_t> pair = std::minmax(*from, *to);
      if (contacts_.apart.contains(pair)) {
        joined_.insert(pair);
      } else {
        item["collide"] = true;
      }
    }
    return item;
  }

  void addJoint(std::size_t index) {
    const MjcfSurface& surface = model_.surfaces[index];
    const MjcfJoint& joint = surface.joint;
    JointJson item = begin(joint.name, joint.type == "slide" ? "slider" : joint.type, index, surface.parent);
    item["at"] = coordinatesOf(surface.body.position + surface.body.turn * joint.position);
    if (joint.hasCoordinate()) {
      item["axis"] = coordinatesOf(surface.body.turn * joint.axis);
      if (surface.coordinate != 0) {
        item["start"] = surface.coordinate;
      }
      if (document_.isLimited(*joint.element, joint.limited, joint.range)) {
        item["range"] = {joint.range[0], joint.range[1]};
      }
      if (joint.stiffness != 0) {
        item["spring"] = {{"stiffness", joint.stiffness}, {"rest", joint.springRef}};
      }
      if (joint.damping != 0) {
        item["damping"] = joint.damping;
      }
      if (joint.friction != 0) {
        item["friction"] = joint.friction;
      }
    }
    joints_.push_back(item);
  }

  // Of the two ends a box is the first.
  void addRope(const MjcfRope& rope) {
    const double distance = (model_.placeOf(rope.to) - model_.placeOf(rope.from)).norm();
    const double off = distance - rope.length;
    if ((rope.isRod ? std::fabs(off) : off) > kMjcfCentered * rope.length) {
      document_.fail(*rope.element,
                     "a length of " + brief(rope.length) + " m between points that start " + brief(distance) +
                         " m apart",
                     rope.isRod ? "their distance" : "at least their distance");
    }
    JointJson item = begin(rope.name, rope.isRod ? "rod" : "rope", rope.from.surface, rope.to.surface);
    item["points"] = {coordinatesOf(rope.from.point), coordinatesOf(rope.to.point)};
    item["length"] = rope.length;
    joints_.push_back(item);
  }

  const MjcfDocument& document_;
  const MjcfModel& model_;
  const MjcfContacts& contacts_;
  JointJson joints_ = JointJson::array();
  std::set<std::pair<std::size_t, std::size_t>> joined_;  // that pass through each other
};

JointJson controlOf(const MjcfModel& model, const MjcfLinks& links, double duration) {
  constexpr double kMostSamples = 1e6;
  JointJson motors = JointJson::array();
  for (const MjcfMotor& each : links.motors) {
    JointJson motor = {{"joint", model.surfaces[each.surface].joint.name}, {"kp", each.kp}, {"kd", each.kd}};
    if (each.target != 0) {
      motor["target"] = each.target;
    }
    if (each.largest > 0) {
      motor["max"] = each.largest;
    }
    motors.push_back(motor);
  }
  return {{"period", std::max(links.timestep, 2 * duration / kMostSamples)}, {"motors", motors}};
}

}  // namespace

void writeJoints(const MjcfDocument& document, const MjcfModel& model, const MjcfLinks& links,
                 const MjcfContacts& contacts, double duration, nlohmann::ordered_json& scene) {
  JointWriter writer(document, model, contacts);
  if (JointJson joints = writer.write(links); !joints.empty()) {
    scene["joints"] = std::move(joints);
  }
  if (JointJson lists = writer.passThrough(); !lists.empty()) {
    scene["pass_through"] = std::move(lists);
  }
  if (!links.motors.empty()) {
    scene["control"] = controlOf(model, links, duration);
  }
}

}  // namespace careen
