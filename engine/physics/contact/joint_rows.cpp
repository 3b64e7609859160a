#include "physics/contact/joint_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace careen {
namespace {

/// [1] of a rope's length: ends this near to each other have no direction.
constexpr double kNoDirection = 0x1p-30;
/// [1] of the speeds of what a grip holds: rounding error of its rate.
constexpr double kStillRate = 0x1p-44;

/// Both ends of a joint at one moment.
struct Ends {
  Ends(const Joint& of, const Kinematics& a, const Kinematics& b)
      : joint(of),
        ofA(a),
        ofB(b),
        pointA(of.from.pointAt(a.pose)),
        pointB(of.to.pointAt(b.pose)),
        armA(pointA - a.pose.position),
        armB(pointB - b.pose.position),
        apart(pointA - pointB) {}

  const Joint& joint;
  const Kinematics& ofA;
  const Kinematics& ofB;
  Vec3 pointA;
  Vec3 pointB;
  Vec3 armA;
  Vec3 armB;
  Vec3 apart;  // d

  Vec3 velocityA() const { return ofA.velocity + ofA.angularVelocity.cross(armA); }
  Vec3 velocity() const { return velocityA() - (ofB.velocity + ofB.angularVelocity.cross(armB)); }
  Vec3 centripetal(const Vec3& armOfB) const {
    const Vec3& spinA = ofA.angularVelocity;
    const Vec3& spinB = ofB.angularVelocity;
    return spinA.cross(spinA.cross(armA)) - spinB.cross(spinB.cross(armOfB));
  }
  Vec3 spin() const { return ofA.angularVelocity - ofB.angularVelocity; }
};

ConstraintRows noRows() {
  ConstraintRows rows;
  for (RowSide* side : {&rows.a, &rows.b}) {
    side->linear.fill(Vec3::Zero());
    side->turning.fill(Vec3::Zero());
  }
  return rows;
}

void setRow(RowSide& side, std::size_t row, const Vec3& linear, const Vec3& turning) {
  side.linear[row] = linear;
  side.turning[row] = turning;
}

ConstraintRows rowsOfPoint(const Ends& at) {
  ConstraintRows rows;
  const std::array<Vec3, 3> axes{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  rows.a = pointSide(axes, at.armA, 1);
  rows.b = pointSide(axes, at.armB, -1);
  rows.gaps = at.apart;
  rows.rates = at.velocity();
  rows.biases = at.centripetal(at.armB);
  return rows;
}

// Of a slider's point along an axis n that turns with b.
void setRowAlong(const Ends& at, const Vec3& n, std::size_t row, ConstraintRows& rows) {
  const auto k = static_cast<Eigen::Index>(row);
  const Vec3 arm = at.armB + at.apart;
  const Vec3 velocity = at.velocityA() - (at.ofB.velocity + at.ofB.angularVelocity.cross(arm));
  setRow(rows.a, row, n, at.armA.cross(n));
  setRow(rows.b, row, -n, -arm.cross(n));
  rows.gaps[k] = dot(n, at.apart);
  rows.rates[k] = dot(n, velocity);
  rows.biases[k] = dot(n, at.centripetal(arm)) + 2 * dot(at.ofB.angularVelocity.cross(n), velocity);
}

// Across a slider's axis.
ConstraintRows rowsAcross(const Ends& at) {
  ConstraintRows rows = noRows();
  const Mat3 axes = at.joint.to.axesAt(at.ofB.pose);
  for (std::size_t row = 0; row < 2; ++row) {
    setRowAlong(at, axes.col(static_cast<Eigen::Index>(row)), row, rows);
  }
  return rows;
}

ConstraintRows rowsOfTurning(const Ends& at, double length) {
  ConstraintRows rows = noRows();
  const Mat3 axesA = at.joint.from.axesAt(at.ofA.pose);
  const Mat3 axesB = at.joint.to.axesAt(at.ofB.pose);
  const std::array<std::pair<int, int>, 3> pairs{std::pair(2, 0), std::pair(2, 1), std::pair(0, 1)};
  const std::size_t count = at.joint.kind == Joint::Kind::kHinge ? 2 : 3;
  const Vec3 spin = at.spin();
  for (std::size_t row = 0; row < count; ++row) {
    const auto k = static_cast<Eigen::Index>(row);
    const Vec3 e = axesA.col(pairs[row].first);
    const Vec3 f = axesB.col(pairs[row].second);
    const Vec3 turning = length * e.cross(f);
    setRow(rows.a, row, Vec3::Zero(), turning);
    setRow(rows.b, row, Vec3::Zero(), -turning);
    rows.gaps[k] = length * dot(e, f);
    rows.rates[k] = dot(turning, spin);
    rows.biases[k] =
        length *
        dot(at.ofA.angularVelocity.cross(e).cross(f) + e.cross(at.ofB.angularVelocity.cross(f)), spin);
  }
  return rows;
}

struct Distance {
  double length = 0;  // [m]
  Vec3 along = Vec3::UnitZ();
  double bias = 0;  // [m/s²] of the length
};

Distance distanceOf(const Ends& at) {
  Distance distance{.length = at.apart.norm()};
  if (distance.length > kNoDirection * at.joint.length) {
    distance.along = at.apart / distance.length;
    const Vec3 velocity = at.velocity();
    const Vec3 across = velocity - dot(distance.along, velocity) * distance.along;
    distance.bias = dot(distance.along, at.centripetal(at.armB)) + across.squaredNorm() / distance.length;
  }
  return distance;
}

ConstraintRows rowsOfRod(const Ends& at) {
  ConstraintRows rows = noRows();
  const Distance distance = distanceOf(at);
  const Vec3& u = distance.along;
  setRow(rows.a, 0, u, at.armA.cross(u));
  setRow(rows.b, 0, -u, -at.armB.cross(u));
  rows.gaps[0] = distance.length - at.joint.length;
  rows.rates[0] = dot(u, at.velocity());
  rows.biases[0] = distance.bias;
  return rows;
}

// Of a hinge's turning about its axis, times a length, which may be negative.
ConstraintRows rowsAbout(const Ends& at, double signedLength) {
  ConstraintRows rows = noRows();
  const Vec3 axis = at.joint.to.axesAt(at.ofB.pose).col(2);
  const Vec3 turning = signedLength * axis;
  setRow(rows.a, 0, Vec3::Zero(), turning);
  setRow(rows.b, 0, Vec3::Zero(), -turning);
  rows.rates[0] = dot(turning, at.spin());
  rows.biases[0] = signedLength * dot(at.ofB.angularVelocity.cross(axis), at.spin());
  return rows;
}

ConstraintRows rowsOfAngle(const Ends& at, JointPart part, double length) {
  const bool isLowest = part == JointPart::kLowest;
  const double signedLength = isLowest ? length : -length;
  ConstraintRows rows = rowsAbout(at, signedLength);
  const double end = isLowest ? at.joint.lowest : at.joint.highest;
  rows.gaps[0] = signedLength * (jointCoordinate(at.joint, at.ofA.pose, at.ofB.pose) - end);
  return rows;
}

// A point's along a normal that turns with b, as if it were a face's.
ContactState stateOfWay(const Ends& at, JointPart part) {
  const Vec3 axis = at.joint.to.axesAt(at.ofB.pose).col(2);
  const bool isLowest = part == JointPart::kLowest;
  const Vec3 normal = isLowest ? axis : Vec3(-axis);
  ContactState state;
  state.armA = at.armA;
  state.armB = at.armB + at.apart;
  const double way = dot(axis, at.apart);
  state.gap = isLowest ? way - at.joint.lowest : at.joint.highest - way;
  state.slip = at.velocityA() - (at.ofB.velocity + at.ofB.angularVelocity.cross(state.armB));
  state.centripetal = at.centripetal(state.armB);
  state.setNormal(normal, at.ofB.angularVelocity.cross(normal));
  return state;
}

ContactState stateOfRope(const Ends& at) {
  const Distance distance = distanceOf(at);
  ContactState state;
  state.armA = at.armA;
  state.armB = at.armB;
  state.gap = at.joint.length - distance.length;
  state.slip = at.velocity();
  state.setNormal(-distance.along, Vec3::Zero());
  state.gapBias = -distance.bias;
  return state;
}

ContactState stateOfRows(const Ends& at, ConstraintRows rows, ContactFeature::Kind kind) {
  ContactState state;
  state.armA = at.armA;
  state.armB = at.armB;
  const bool holds = kind == ContactFeature::Kind::kJoint;
  state.gap = holds ? rows.gaps.norm() : rows.gaps[0];
  state.rate = holds ? rows.rates.norm() : rows.rates[0];
  state.gapBias = rows.biases[0];
  state.rows = std::make_shared<const ConstraintRows>(std::move(rows));
  return state;
}

ContactState stateOfGrip(const Ends& at, double length) {
  const bool slides = at.joint.kind == Joint::Kind::kSlider;
  ConstraintRows rows = slides ? noRows() : rowsAbout(at, length);
  if (slides) {
    setRowAlong(at, at.joint.to.axesAt(at.ofB.pose).col(2), 0, rows);
    rows.gaps[0] = 0;
  }
  ContactState state = stateOfRows(at, std::move(rows), ContactFeature::Kind::kJointGrip);
  state.kept = slides ? at.joint.keptRate : length * at.joint.keptRate;
  state.rate -= state.kept;
  const auto speedOf = [&](const Kinematics& of) {
    return of.velocity.norm() + length * of.angularVelocity.norm();
  };
  state.still = kStillRate * (speedOf(at.ofA) + speedOf(at.ofB) + std::fabs(state.kept));
  state.grip = slides ? at.joint.grip : at.joint.grip / length;
  return state;
}

double smallerOf(TouchingShape a, TouchingShape b) {
  const double ofA = a.halfExtents.norm();
  return b.halfSpace != nullptr ? ofA : std::min(ofA, b.halfExtents.norm());
}

}  // namespace

ContactState jointState(const ContactFeature& feature, const Kinematics& a, TouchingShape shapeA,
                        const Kinematics& b, TouchingShape shapeB) {
  const Joint& joint = *feature.joint;
  const Ends at(joint, a, b);
  const double length = smallerOf(shapeA, shapeB);
  switch (feature.part) {
    case JointPart::kPoint:
      return stateOfRows(at, joint.kind == Joint::Kind::kSlider ? rowsAcross(at) : rowsOfPoint(at),
                         feature.kind);
    case JointPart::kTurning:
      return stateOfRows(at, rowsOfTurning(at, length), feature.kind);
    case JointPart::kLength:
      return feature.holds() ? stateOfRows(at, rowsOfRod(at), feature.kind) : stateOfRope(at);
    case JointPart::kLowest:
    case JointPart::kHighest:
      break;
    case JointPart::kGrip:
      return stateOfGrip(at, length);
  }
  return joint.kind == Joint::Kind::kSlider
             ? stateOfWay(at, feature.part)
             : stateOfRows(at, rowsOfAngle(at, feature.part, length), feature.kind);
}

JointImpulse jointImpulseOf(const World& world, double time, const ContactFeature& feature,
                            const ImpactContact& contact, const ImpactShare& share, const Vec3& position) {
  JointImpulse impulse{.time = time,
                       .joint = static_cast<int>(feature.joint - world.joints.data()),
                       .point = position + contact.armA};
  if (contact.rows) {
    const BodyImpulse sum = impulseOf(contact.rows->a, share.rows);
    impulse.linear = sum.push;
    impulse.angular = sum.twist - contact.armA.cross(sum.push);
  } else {
    impulse.linear = share.impulse * share.normal;
  }
  return impulse;
}

std::vector<ContactFeature> jointFeatures(const World& world, double time,
                                          const std::function<int(const JointEnd&)>& placeOf) {
  using Kind = Joint::Kind;
  std::vector<ContactFeature> features;
  for (const Joint& joint : world.joints) {
    const int a = time < joint.until ? placeOf(joint.from) : -1;
    const int b = a < 0 ? -1 : placeOf(joint.to);
    if (b < 0) {
      continue;
    }
    const auto add = [&](ContactFeature::Kind kind, JointPart part) {
      features.push_back({.kind = kind,
                          .a = a,
                          .b = b,
                          .material = {.restitution = joint.restitution},
                          .joint = &joint,
                          .part = part});
    };
    const auto hold = [&](JointPart part) { add(ContactFeature::Kind::kJoint, part); };
    const auto end = [&](JointPart part) { add(ContactFeature::Kind::kJointEnd, part); };
    if (joint.kind == Kind::kRod) {
      hold(JointPart::kLength);
    } else if (joint.kind == Kind::kRope) {
      end(JointPart::kLength);
    } else {
      hold(JointPart::kPoint);
      if (joint.kind != Kind::kBall) {
        hold(JointPart::kTurning);
      }
    }
    if (joint.hasCoordinate() && joint.lowest > -Joint::kFree) {
      end(JointPart::kLowest);
    }
    if (joint.hasCoordinate() && joint.highest < Joint::kFree) {
      end(JointPart::kHighest);
    }
    if (joint.hasCoordinate() && joint.grip > 0) {
      add(ContactFeature::Kind::kJointGrip, JointPart::kGrip);
    }
  }
  return features;
}

}  // namespace careen
