#include "scene/joint_check.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/brief.h"

namespace careen {
namespace {

constexpr std::string_view kWorld = "world";
constexpr double kTurn = 2 * 3.141592653589793;  // [rad]
constexpr double kMostAngle = 1e6 * kTurn;       // of more, little is left of the place within a turn
constexpr double kSameLength = 1e-9;             // [1]
constexpr int kDigitsOfLength = 10;              // of lengths, which may differ by no more than that

/// A joint of the file on its way to one of the world.
class Connecting {
 public:
  Connecting(const JsonTree& tree, const BoxNames& boxes, Scene& scene, std::size_t index)
      : tree_(tree),
        boxes_(boxes),
        scene_(scene),
        node_(tree.root().find("joints")->children[index]),
        joint_(scene.joints[index]),
        label_("joints[" + std::to_string(index) + "]") {}

  void connect() {
    findEnds();
    checkStart();
    checkRange();
    placeEnds();
    measure();
    const JsonNode* const collide = node_.find("collide");
    if (joint_.to.body && (collide == nullptr || !collide->boolean)) {
      scene_.apart.push_back(std::minmax(*joint_.from.body, *joint_.to.body));
    }
  }

 private:
  const JsonNode& member(std::string_view key) const { return *node_.find(key); }
  const SceneBox& box(int index) const { return scene_.boxes[static_cast<std::size_t>(index)]; }

  std::optional<int> end(const JsonNode& name) const {
    if (name.text != kWorld) {
      return boxes_.named(tree_, name);
    }
    if (boxes_.has(kWorld)) {
      tree_.fail(name.offset, R"("world", which is the name of a box too)", "another name for that box");
    }
    return std::nullopt;
  }

  void findEnds() {
    const JsonNode& between = member("between");
    joint_.from.body = end(between.children[0]);
    joint_.to.body = end(between.children[1]);
    if (joint_.from.body == joint_.to.body) {
      tree_.fail(between.offset,
                 joint_.to.body ? "a joint from a box to itself" : "a joint from the world to the world",
                 "two ends that can move apart");
    }
    for (std::size_t k = 0; k < 2; ++k) {
      const std::optional<int>& body = k == 0 ? joint_.from.body : joint_.to.body;
      if (body && !box(*body).course.empty()) {
        tree_.fail(between.children[k].offset,
                   "a joint to box " + inQuotes(box(*body).name) + ", which has a motion",
                   "one to a box without, or to the world");
      }
    }
    const auto isHeld = [this](const std::optional<int>& body) { return !body || box(*body).fixed; };
    if (isHeld(joint_.from.body) && isHeld(joint_.to.body)) {
      tree_.fail(between.offset, "a joint whose ends cannot move", "a box that is not fixed");
    }
    if (!joint_.from.body) {
      turnRound();
    }
  }

  // The coordinate stays that of the end named first: about the opposite axis, the other way round.
  void turnRound() {
    std::swap(joint_.from, joint_.to);
    if (joint_.hasCoordinate()) {
      for (Mat3* const axes : {&joint_.from.axes, &joint_.to.axes}) {
        axes->col(1) = -axes->col(1);
        axes->col(2) = -axes->col(2);
      }
    }
  }

  void checkStart() const {
    const JsonNode* const start = node_.find("start");
    if (start != nullptr && joint_.kind == Joint::Kind::kHinge && std::fabs(start->number) > kMostAngle) {
      tree_.fail(start->offset, brief(start->number) + " rad for " + label_ + ".start",
                 "less than a million turns");
    }
  }

  void checkRange() const {
    const JsonNode* const range = node_.find("range");
    if (range == nullptr) {
      return;
    }
    const auto fail = [&](const std::string& expected) {
      tree_.fail(range->offset,
                 "[" + brief(joint_.lowest) + ", " + brief(joint_.highest) + "] for " + label_ + ".range",
                 expected);
    };
    if (!(joint_.lowest < joint_.highest)) {
      fail("its lowest value first, and a higher one");
    }
    const JsonNode* const given = node_.find("start");
    const double start = given == nullptr ? 0 : given->number;
    if (!(joint_.lowest <= start && joint_.highest >= start)) {
      fail("a range with " + brief(start) + " in it, where the joint starts");
    }
    if (joint_.kind == Joint::Kind::kHinge && !(joint_.highest - joint_.lowest < kTurn)) {
      fail("less than a turn, 2π rad");
    }
  }

  void placeEnds() {
    const bool isPlaced = joint_.kind != Joint::Kind::kRod && joint_.kind != Joint::Kind::kRope;
    if (joint_.kind == Joint::Kind::kFixed && node_.find("at") == nullptr) {
      joint_.from.point = box(*joint_.from.body).pose.position;
      joint_.to.point = joint_.from.point;
    }
    for (JointEnd* const each : {&joint_.from, &joint_.to}) {
      if (isPlaced && each->body) {
        const Pose& pose = box(*each->body).pose;
        each->point = pose.worldFromBody.transpose() * (each->point - pose.position);
        each->axes = pose.worldFromBody.transpose() * each->axes;
      }
    }
  }

  // The length that its points have at the start, so that it does not begin open.
  void measure() {
    if (joint_.kind != Joint::Kind::kRod && joint_.kind != Joint::Kind::kRope) {
      return;
    }
    const auto placeOf = [this](const JointEnd& each) {
      return each.pointAt(each.body ? box(*each.body).pose : Pose{});
    };
    const double distance = Vec3(placeOf(joint_.from) - placeOf(joint_.to)).norm();
    if (node_.find("length") == nullptr) {
      if (!(distance > 0)) {
        tree_.fail(member("points").offset, "one place for both points of " + label_ + " at the start",
                   "two places, or a rope with a length");
      }
      joint_.length = distance;
      return;
    }
    const double off = distance - joint_.length;
    const bool isRod = joint_.kind == Joint::Kind::kRod;
    if ((isRod ? std::fabs(off) : off) > kSameLength * joint_.length) {
      tree_.fail(member("length").offset,
                 describe(member("length")) + " for " + label_ + ".length, which its points exceed by " +
                     brief(off) + " m at the start",
                 (isRod ? "their distance, " : "at least their distance, ") +
                     brief(distance, kDigitsOfLength) + " m");
    }
    joint_.length = isRod ? distance : std::max(joint_.length, distance);
  }

  const JsonTree& tree_;
  const BoxNames& boxes_;
  Scene& scene_;
  const JsonNode& node_;
  Joint& joint_;
  std::string label_;
};

void checkJointNames(const JsonTree& tree, const Scene& scene) {
  std::map<std::string_view, std::size_t> owners;
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    const std::string& name = scene.joints[i].name;
    const auto [first, fresh] = owners.emplace(name, i);
    if (!fresh) {
      const JsonNode& node = tree.root().find("joints")->children[i];
      const JsonNode* const given = node.find("name");
      tree.fail((given != nullptr ? *given : node).offset,
                inQuotes(name) + " for joints[" + std::to_string(i) + "]" +
                    (given == nullptr ? ", its name for want of one" : ""),
                "another name: joints[" + std::to_string(first->second) + "] has this one");
    }
  }
}

void listPassThrough(const JsonTree& tree, const BoxNames& boxes, Scene& scene) {
  const JsonNode* const lists = tree.root().find("pass_through");
  for (std::size_t i = 0; lists != nullptr && i < lists->children.size(); ++i) {
    std::vector<int> members;
    for (const JsonNode& name : lists->children[i].children) {
      const int box = boxes.named(tree, name);
      for (const int other : members) {
        if (other == box) {
          tree.fail(name.offset, "box " + inQuotes(name.text) + " twice in one list", "each box once");
        }
        scene.apart.push_back(std::minmax(box, other));
      }
      members.push_back(box);
    }
  }
}

// Its times.
void checkPath(const JsonTree& tree, const JsonNode& motor, const MotorTarget& target, std::size_t index) {
  for (std::size_t k = 1; k < target.path.size(); ++k) {
    if (!(target.path[k].first > target.path[k - 1].first)) {
      const JsonNode& time = motor.find("target")->find("path")->children[k].children[0];
      tree.fail(time.offset,
                describe(time) + " for control.motors[" + std::to_string(index) + "].target.path[" +
                    std::to_string(k) + "][0]",
                "a time after that of the point before");
    }
  }
}

}  // namespace

void connectMotors(const JsonTree& tree, Scene& scene) {
  if (!scene.control) {
    return;
  }
  constexpr double kMostSamples = 1e6;
  const JsonNode& control = *tree.root().find("control");
  const JsonNode& period = *control.find("period");
  if (scene.control->period * kMostSamples < scene.settings.duration) {
    tree.fail(period.offset, describe(period) + " for control.period, more than a million samples",
              "a longer period, or a shorter scene");
  }
  const auto jointNamed = [&](const std::string& name, std::size_t offset) {
    for (std::size_t j = 0; j < scene.joints.size(); ++j) {
      if (scene.joints[j].name == name) {
        if (!scene.joints[j].hasCoordinate()) {
          tree.fail(offset, "joint " + inQuotes(name) + ", which has no coordinate", "a hinge or slider");
        }
        return static_cast<int>(j);
      }
    }
    tree.fail(offset, "unknown joint " + inQuotes(name), "the name of a joint");
  };
  const JsonNode& motors = *control.find("motors");
  for (std::size_t i = 0; i < motors.children.size(); ++i) {
    Motor& motor = scene.control->motors[i];
    const JsonNode& joint = *motors.children[i].find("joint");
    motor.joint = jointNamed(joint.text, joint.offset);
    checkPath(tree, motors.children[i], motor.target, i);
    for (std::size_t k = 0; k < motor.gains.size(); ++k) {
      const JsonNode& gain = motors.children[i].find("gains")->children[k];
      motor.gains[k].joint = jointNamed(gain.key, gain.keyOffset);
    }
  }
}

void connectJoints(const JsonTree& tree, const BoxNames& boxes, Scene& scene) {
  checkJointNames(tree, scene);
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    Connecting(tree, boxes, scene, i).connect();
  }
  listPassThrough(tree, boxes, scene);
  std::sort(scene.apart.begin(), scene.apart.end());
  scene.apart.erase(std::unique(scene.apart.begin(), scene.apart.end()), scene.apart.end());
}

}  // namespace careen
