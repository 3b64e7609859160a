#include "exchange/export_mjcf_joints.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/brief.h"
#include "exchange/mjcf_text.h"
#include "scene/json_shape.h"

namespace careen {
namespace {

class JointEncoder {
 public:
  JointEncoder(const World& world, const MjcfTree& tree) : world_(world), tree_(tree) {}

  MjcfJoints encode() {
    result_.ofBody.resize(world_.bodies.size());
    for (std::size_t i = 0; i < world_.bodies.size(); ++i) {
      if (tree_.joint[i]) {
        inTree_.insert(*tree_.joint[i]);
        result_.ofBody[i] = elementOf(i);
      }
    }
    for (const std::size_t each : tree_.closing) {
      close(world_.joints[each]);
    }
    for (std::size_t i = 0; i < world_.joints.size(); ++i) {
      if (isLine(world_.joints[i])) {
        addLine(i);
      }
    }
    addExcludes();
    addMotors();
    for (const int body : tree_.order) {
      addStart(static_cast<std::size_t>(body));
    }
    tellWhatIsLeftOut();
    return std::move(result_);
  }

 private:
  static bool isLine(const Joint& joint) {
    return joint.kind == Joint::Kind::kRod || joint.kind == Joint::Kind::kRope;
  }
  static bool isLimited(const Joint& joint) {
    return std::isfinite(joint.lowest) || std::isfinite(joint.highest);
  }
  const Body& bodyAt(int index) const { return world_.bodies[static_cast<std::size_t>(index)]; }
  Pose poseOf(const std::optional<int>& body) const { return body ? bodyAt(*body).initial.pose : Pose{}; }
  static void append(std::string& text, const std::string& more) { text += (text.empty() ? "" : " ") + more; }

  // ---- Joints of the tree

  /// A joint as the body has it that it holds.
  struct Held {
    const Joint& joint;
    const JointEnd& end;  // on the body
    double sign;          // of its coordinate and axis: that of `from` relative to `to` about z

    Vec3 axis(const Pose& pose) const { return sign * end.axesAt(pose).col(2); }
  };
  Held heldBy(std::size_t body) const {
    const Joint& joint = world_.joints[*tree_.joint[body]];
    const bool isFrom = joint.from.body == static_cast<int>(body);
    return {.joint = joint, .end = isFrom ? joint.from : joint.to, .sign = isFrom ? 1.0 : -1.0};
  }

  double startOf(const Joint& joint) const {
    const double start = jointCoordinate(joint, poseOf(joint.from.body), poseOf(joint.to.body));
    return std::clamp(start, joint.lowest, joint.highest);  // where rounding took it out
  }

  std::string elementOf(std::size_t body) const {
    const auto [joint, end, sign] = heldBy(body);
    if (joint.kind == Joint::Kind::kFixed) {
      return "";
    }
    std::string text = "<joint" + mjcfAttribute("name", joint.name) +
                       mjcfAttribute("type", joint.kind == Joint::Kind::kSlider  ? "slide"
                                             : joint.kind == Joint::Kind::kHinge ? "hinge"
                                                                                 : "ball") +
                       mjcfAttribute("pos", mjcfNumbers(inBoxFrame(world_.bodies[body], end.point)));
    if (!joint.hasCoordinate()) {
      return text + "/>";
    }
    text += mjcfAttribute("axis", mjcfNumbers(Vec3(sign * end.axes.col(2) + Vec3::Zero()))) +
            mjcfAttribute("ref", inFull(startOf(joint)));
    if (isLimited(joint)) {
      text += mjcfAttribute("limited", "true") +
              mjcfAttribute("range", mjcfNumbers({joint.lowest, joint.highest}));
    }
    if (joint.stiffness != 0) {
      text += mjcfAttribute("stiffness", inFull(joint.stiffness)) +
              mjcfAttribute("springref", inFull(joint.rest));
    }
    if (joint.grip != 0 && joint.keptRate == 0) {
      text += mjcfAttribute("frictionloss", inFull(joint.grip));
    }
    return text + (joint.damping != 0 ? mjcfAttribute("damping", inFull(joint.damping)) : "") + "/>";
  }

  // ---- Other joints

  std::string ends(const Joint& joint) const {
    return mjcfAttribute("body1", bodyAt(*joint.from.body).name) +
           (joint.to.body ? mjcfAttribute("body2", bodyAt(*joint.to.body).name) : std::string());
  }

  // A hinge has two points of its axis in common, as far apart as the body is large.
  void close(const Joint& joint) {
    const Body& body = bodyAt(*joint.from.body);
    const auto connect = [&](const std::string& name, const Vec3& point) {
      result_.equalities.push_back("<connect" + mjcfAttribute("name", name) + ends(joint) +
                                   mjcfAttribute("anchor", mjcfNumbers(inBoxFrame(body, point))) + "/>");
    };
    if (joint.kind == Joint::Kind::kFixed) {
      result_.equalities.push_back("<weld" + mjcfAttribute("name", joint.name) + ends(joint) + "/>");
    } else if (joint.kind == Joint::Kind::kBall) {
      connect(joint.name, joint.from.point);
    } else if (joint.kind == Joint::Kind::kHinge) {
      const Vec3 half = radiusOf(body) * joint.from.axes.col(2);
      connect(joint.name + " below", joint.from.point - half);
      connect(joint.name + " above", joint.from.point + half);
      if (isLimited(joint) || joint.isLoaded()) {
        result_.leftOut.push_back("limits, springs and friction of " + joint.name +
                                  ", which closes a loop or long chain");
      }
    } else {
      result_.leftOut.push_back(joint.name + ", a slider that closes a loop or long chain");
    }
  }

  void addLine(std::size_t index) {
    const Joint& joint = world_.joints[index];
    const bool isRope = joint.kind == Joint::Kind::kRope;
    result_.tendons.push_back(
        "<spatial" + mjcfAttribute("name", joint.name) +
        (isRope ? mjcfAttribute("limited", "true") + mjcfAttribute("range", mjcfNumbers({0, joint.length}))
                : "") +
        "><site" + mjcfAttribute("site", mjcfSite("joint", index, "from")) + "/><site" +
        mjcfAttribute("site", mjcfSite("joint", index, "to")) + "/></spatial>");
    if (!isRope) {
      result_.equalities.push_back("<tendon" + mjcfAttribute("tendon1", joint.name) + "/>");
    }
  }

  // MuJoCo lets those through each other by itself that are one body, or one in the other.
  void addExcludes() {
    for (const auto& [a, b] : world_.apart) {
      if (!tree_.areJoined(a, b)) {
        result_.excludes.push_back("<exclude" + mjcfAttribute("body1", bodyAt(a).name) +
                                   mjcfAttribute("body2", bodyAt(b).name) + "/>");
      }
    }
  }

  void addMotors() {
    if (!world_.control) {
      return;
    }
    result_.leftOut.emplace_back("what motors aim at");
    for (const Motor& motor : world_.control->motors) {
      const Joint& joint = world_.joints[static_cast<std::size_t>(motor.joint)];
      if (!inTree_.contains(static_cast<std::size_t>(motor.joint))) {
        result_.leftOut.push_back("the motor of " + joint.name + ", which closes a loop or long chain");
        continue;
      }
      const bool isLimited = motor.largest < kLargestNumber;
      result_.actuators.push_back(
          "<motor" + mjcfAttribute("joint", joint.name) +
          (isLimited ? mjcfAttribute("ctrllimited", "true") +
                           mjcfAttribute("ctrlrange", mjcfNumbers({-motor.largest, motor.largest}))
                     : "") +
          "/>");
    }
  }

  // ---- The start

  /// Of a body, or of what does not move: [m/s] of the centre of mass, and [rad/s].
  struct Velocity {
    Vec3 linear = Vec3::Zero();
    Vec3 angular = Vec3::Zero();
    Vec3 center = Vec3::Zero();

    Vec3 at(const Vec3& place) const { return linear + angular.cross(Vec3(place - center)); }
  };
  Velocity velocityOf(const std::optional<int>& index) const {
    if (!index || isImmovable(bodyAt(*index).mass)) {
      return {};
    }
    const Body& body = bodyAt(*index);
    return {.linear = body.initial.velocity,
            .angular = angularVelocity(body.mass, body.initial),
            .center = body.initial.pose.position};
  }

  // Of a free joint: position and quaternion; velocity in the world's frame, angular velocity in the body's.
  // Of a ball both are relative to what it is in.
  void addStart(std::size_t index) {
    const Body& body = world_.bodies[index];
    const Pose& pose = body.initial.pose;
    const Velocity own = velocityOf(static_cast<int>(index));
    if (tree_.isFree(world_, static_cast<int>(index))) {
      append(result_.places, mjcfNumbers(boxPose(body, pose).position));
      append(result_.places, mjcfNumbers(Quat(pose.worldFromBody).normalized()));
      append(result_.speeds, mjcfNumbers(boxVelocity(body, body.initial)));
      append(result_.speeds, mjcfNumbers(Vec3(pose.worldFromBody.transpose() * own.angular)));
      return;
    }
    if (!tree_.joint[index] || isImmovable(body.mass)) {
      return;
    }
    const Held held = heldBy(index);
    const Velocity other = velocityOf(tree_.parent[index]);
    if (held.joint.kind == Joint::Kind::kBall) {
      append(result_.places, mjcfNumbers(Quat::Identity()));
      append(result_.speeds,
             mjcfNumbers(Vec3(pose.worldFromBody.transpose() * Vec3(own.angular - other.angular))));
    } else if (held.joint.hasCoordinate()) {
      const Vec3 place = held.end.pointAt(pose);
      const Vec3 relative = held.joint.kind == Joint::Kind::kHinge ? Vec3(own.angular - other.angular)
                                                                   : Vec3(own.at(place) - other.at(place));
      append(result_.places, inFull(startOf(held.joint)));
      append(result_.speeds, inFull(dot(held.axis(pose), relative)));
    }
  }

  // [m/s] What a joint takes away at once.
  double forbidden(const Joint& joint) const {
    const Velocity one = velocityOf(joint.from.body);
    const Velocity other = velocityOf(joint.to.body);
    const Vec3 place = joint.from.pointAt(poseOf(joint.from.body));
    const Vec3 axis = joint.to.axesAt(poseOf(joint.to.body)).col(2);
    Vec3 linear = one.at(place) - other.at(place);
    Vec3 angular = one.angular - other.angular;
    if (joint.kind == Joint::Kind::kBall) {
      angular.setZero();
    } else if (joint.kind == Joint::Kind::kHinge) {
      angular -= dot(axis, angular) * axis;
    } else if (joint.kind == Joint::Kind::kSlider) {
      linear -= dot(axis, linear) * axis;
    }
    return linear.norm() + radiusOf(bodyAt(*joint.from.body)) * angular.norm();
  }

  void tellWhatIsLeftOut() {
    const auto any = [this](const auto& asked) {
      return std::any_of(world_.joints.begin(), world_.joints.end(), asked);
    };
    if (any([](const Joint& joint) { return std::isfinite(joint.until); })) {
      result_.leftOut.emplace_back("when joints let go");
    }
    if (any([](const Joint& joint) { return joint.keptRate != 0; })) {
      result_.leftOut.emplace_back("drives of joints");
    }
    if (any([this](const Joint& joint) {
          const double speed =
              velocityOf(joint.from.body).linear.norm() + velocityOf(joint.to.body).linear.norm();
          return !isLine(joint) && forbidden(joint) > kMjcfForbidden * (1 + speed);
        })) {
      result_.leftOut.emplace_back("velocities that joints do not allow");
    }
  }
  static constexpr double kMjcfForbidden = 1e-9;  // [1] of speeds, and of 1 m/s

  const World& world_;
  const MjcfTree& tree_;
  MjcfJoints result_;
  std::set<std::size_t> inTree_;
};

}  // namespace

MjcfJoints encodeJoints(const World& world, const MjcfTree& tree) {
  return JointEncoder(world, tree).encode();
}

Vec3 inBoxFrame(const Body& body, const Vec3& point) {
  return body.boxCenter.isZero(0) ? point : Vec3(point - body.boxCenter);
}

std::string mjcfSite(const std::string& kind, std::size_t index, const char* end) {
  return kind + " " + std::to_string(index) + " " + end;
}

}  // namespace careen
