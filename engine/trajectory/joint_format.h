#pragma once

#include <utility>

#include "physics/motion/recorder.h"
#include "physics/world/joint.h"
#include "trajectory/archive.h"
#include "trajectory/motion_format.h"

namespace careen {

// Joints in a trajectory file, since format version 10.

template <class Archive>
void visit(Archive& archive, Visited<Archive, JointEnd> end) {
  visitOptional(archive, end.body);
  visit(archive, end.point);
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      archive.visit(end.axes(row, column));
    }
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Joint> joint) {
  archive.visit(joint.name);
  visitNamed(archive, joint.kind, kJointKindNames);
  visit(archive, joint.from);
  visit(archive, joint.to);
  archive.visit(joint.length);
  archive.visit(joint.lowest);
  archive.visit(joint.highest);
  archive.visit(joint.restitution);
  archive.visit(joint.until);
  archive.visit(joint.stiffness);
  archive.visit(joint.rest);
  archive.visit(joint.damping);
}

/// What a joint has since format version 11, stored after the rest.
template <class Archive>
void visitGrip(Archive& archive, Visited<Archive, Joint> joint) {
  archive.visit(joint.grip);
  archive.visit(joint.keptRate);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, std::pair<int, int>> bodies) {
  visitIndex(archive, bodies.first);
  visitIndex(archive, bodies.second);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, JointImpulse> impulse) {
  archive.visit(impulse.time);
  visitIndex(archive, impulse.joint);
  visit(archive, impulse.point);
  visit(archive, impulse.linear);
  visit(archive, impulse.angular);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, JointEffort> effort) {
  archive.visit(effort.time);
  visitIndex(archive, effort.joint);
  archive.visit(effort.effort);
}

}  // namespace careen
