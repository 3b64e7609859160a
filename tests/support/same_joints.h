#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "physics/world/world.h"

namespace careen {

/// The largest differences between the joints of two worlds of the same boxes, whatever their order and which
/// end comes first. A hinge of the first that closes a loop may be two balls on its axis; fixed
/// ones may have other names.
struct JointDifference {
  double place = 0;       // [m] of points, [1] of axes
  double coordinate = 0;  // and limits
  std::size_t count = 0;
  std::size_t asBalls = 0;

  static void most(double& of, double found) { of = found <= of ? of : found; }  // NaN counts

  void compare(const World& a, const World& b) {
    std::map<std::string, const Joint*> found;
    for (const Joint& joint : b.joints) {
      found[joint.name] = &joint;
      if (joint.kind == Joint::Kind::kFixed) {
        found[pairOf(b, joint)] = &joint;
      }
    }
    std::size_t expected = a.joints.size();
    for (const Joint& joint : a.joints) {
      if (joint.kind == Joint::Kind::kHinge && found.contains(joint.name + " above")) {
        ++expected;
        ++asBalls;
        for (const char* end : {" above", " below"}) {
          ASSERT_TRUE(found.contains(joint.name + end)) << joint.name;
          compareBall(a, joint, b, *found[joint.name + end]);
        }
        continue;
      }
      const std::string name = joint.kind == Joint::Kind::kFixed ? pairOf(a, joint) : joint.name;
      ASSERT_TRUE(found.contains(name)) << joint.name;
      compareJoint(a, joint, b, *found[name]);
    }
    EXPECT_EQ(expected, b.joints.size());
  }

 private:
  static std::string nameOf(const World& world, const JointEnd& end) {
    return end.body ? world.bodies[static_cast<std::size_t>(*end.body)].name : "world";
  }
  static std::string pairOf(const World& world, const Joint& joint) {
    const std::string one = nameOf(world, joint.from);
    const std::string other = nameOf(world, joint.to);
    return std::min(one, other) + " and " + std::max(one, other);
  }
  static Pose poseOf(const World& world, const JointEnd& end) {
    return end.body ? world.bodies[static_cast<std::size_t>(*end.body)].initial.pose : Pose{};
  }

  void compareBall(const World& a, const Joint& hinge, const World& b, const Joint& ball) {
    EXPECT_EQ(ball.kind, Joint::Kind::kBall) << ball.name;
    const Pose pose = poseOf(a, hinge.from);
    const Vec3 off = hinge.from.pointAt(pose) - ball.from.pointAt(poseOf(b, ball.from));
    most(place, off.cross(Vec3(hinge.from.axesAt(pose).col(2))).norm());
  }

  void compareJoint(const World& a, const Joint& one, const World& b, const Joint& other) {
    ++count;
    const bool isSwapped = nameOf(a, one.from) != nameOf(b, other.from);
    const JointEnd& from = isSwapped ? other.to : other.from;
    const JointEnd& to = isSwapped ? other.from : other.to;
    EXPECT_EQ(one.kind, other.kind) << one.name;
    EXPECT_EQ(nameOf(a, one.from), nameOf(b, from)) << one.name;
    EXPECT_EQ(nameOf(a, one.to), nameOf(b, to)) << one.name;
    if (one.kind == Joint::Kind::kFixed) {
      return;  // wherever its points are
    }
    most(place, (one.from.pointAt(poseOf(a, one.from)) - from.pointAt(poseOf(b, from))).norm());
    if (one.kind == Joint::Kind::kRope || one.kind == Joint::Kind::kRod) {
      most(place, (one.to.pointAt(poseOf(a, one.to)) - to.pointAt(poseOf(b, to))).norm());
      most(place, std::fabs(one.length - other.length));
    }
    if (!one.hasCoordinate()) {
      return;
    }
    const double sign = isSwapped ? -1 : 1;
    most(place,
         (one.from.axesAt(poseOf(a, one.from)).col(2) - sign * from.axesAt(poseOf(b, from)).col(2)).norm());
    most(place, (one.to.axesAt(poseOf(a, one.to)).col(2) - sign * to.axesAt(poseOf(b, to)).col(2)).norm());
    most(coordinate, std::fabs(jointCoordinate(one, poseOf(a, one.from), poseOf(a, one.to)) -
                               jointCoordinate(other, poseOf(b, other.from), poseOf(b, other.to))));
    EXPECT_EQ(one.lowest, other.lowest) << one.name;
    EXPECT_EQ(one.highest, other.highest) << one.name;
    EXPECT_EQ(one.stiffness, other.stiffness) << one.name;
    EXPECT_EQ(one.stiffness == 0 ? 0 : one.rest, other.rest) << one.name;
    EXPECT_EQ(one.damping, other.damping) << one.name;
    EXPECT_EQ(one.keptRate == 0 ? one.grip : 0, other.grip) << one.name;
  }
};

}  // namespace careen
