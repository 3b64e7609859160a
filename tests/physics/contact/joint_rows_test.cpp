#include "physics/contact/joint_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "support/article_equations.h"
#include "support/jointed.h"

namespace careen {
namespace {

const Vec3 kHalvesOfA(0.3, 0.2, 0.1);
const Vec3 kHalvesOfB(0.25, 0.4, 0.35);

// A body that turns steadily about a fixed axis while its centre runs along a parabola: known at any moment.
struct Swing {
  Vec3 position;
  Vec3 velocity;
  Vec3 acceleration;
  Vec3 spin;
  Mat3 attitude;

  Kinematics at(double t) const {
    return {{Vec3(position + velocity * t + 0.5 * t * t * acceleration),
             axisAngle(spin.normalized(), spin.norm() * t) * attitude},
            velocity + t * acceleration,
            spin};
  }
};

const Swing kA{Vec3(0.1, -0.2, 0.5), Vec3(0.3, 0.1, -0.2), Vec3(0.2, -0.5, 0.4), Vec3(0.7, 1.1, -0.3),
               axisAngle(Vec3(1, 1, 0).normalized(), 0.7)};
const Swing kB{Vec3(-0.2, 0.1, 0.0), Vec3(-0.1, 0.2, 0.1), Vec3(-0.3, 0.1, 0.2), Vec3(-0.2, 0.6, 0.5),
               axisAngle(Vec3(0, 1, 1).normalized(), -0.4)};

// Both ends are well apart, so that every term shows.
Joint jointOf(Joint::Kind kind) {
  Joint joint;
  joint.kind = kind;
  joint.from = {.body = 0, .point = Vec3(0.3, 0.1, -0.2), .axes = test::frameAlong(Vec3(1, 0.3, 0.2))};
  joint.to = {.body = 1, .point = Vec3(-0.1, 0.4, 0.2), .axes = test::frameAlong(Vec3(0.5, 1, -0.4))};
  joint.length = 0.7;
  joint.lowest = -0.4;
  joint.highest = 0.6;
  return joint;
}

// A limited hinge of two bodies, and a rope of the second one.
World floorless() {
  World world;
  world.bodies = {box("a", kHalvesOfA, 1, Vec3::Zero()), box("b", kHalvesOfB, 1, Vec3(1, 0, 0))};
  test::join(world, Joint::Kind::kHinge, 0, 1, Vec3(0.5, 0, 0)).highest = 1;
  test::tie(world, Joint::Kind::kRope, 1, Vec3::Zero(), Vec3(1, 0, 2), 3).restitution = 0.5;
  return world;
}

ContactState stateAt(const ContactFeature& feature, double t) {
  return jointState(feature, kA.at(t), {kHalvesOfA}, kB.at(t), {kHalvesOfB});
}

// Of one coordinate of it: the rows on both motions.
double along(const RowSide& a, const RowSide& b, std::size_t row, const Vec3& linearA, const Vec3& turningA,
             const Vec3& linearB, const Vec3& turningB) {
  return a.linear[row].dot(linearA) + a.turning[row].dot(turningA) + b.linear[row].dot(linearB) +
         b.turning[row].dot(turningB);
}

// The rows on the velocities are the rates of the coordinates; on accelerations, and with the biases, the
// rates of these: against differences, where neither body's turning is accelerated. Turning conditions and
// angles only mean something near zero: their own rates differ from those of rows where axes are not aligned,
// which is not so here for rates of e·f, but for angles.
void expectDerivatives(Joint::Kind kind, JointPart part, ContactFeature::Kind holds, std::size_t rows) {
  const Joint joint = jointOf(kind);
  const ContactFeature feature{.kind = holds, .a = 0, .b = 1, .joint = &joint, .part = part};
  const double h = 1e-4;
  const ContactState now = stateAt(feature, 0);
  const ContactState before = stateAt(feature, -h);
  const ContactState after = stateAt(feature, h);
  const ContactFrame frame = frameOf(now.normal);
  const RowSide a = now.sideA(frame);
  const RowSide b = now.sideB(frame);
  const auto gap = [](const ContactState& state, std::size_t row) {
    return state.rows ? state.rows->gaps[static_cast<Eigen::Index>(row)] : state.gap;
  };
  for (std::size_t row = 0; row < rows; ++row) {
    const auto k = static_cast<Eigen::Index>(row);
    const double rate = along(a, b, row, kA.velocity, kA.spin, kB.velocity, kB.spin);
    const double bias = now.rows ? now.rows->biases[k] : now.gapBias;
    EXPECT_NEAR(rate, now.rows ? now.rows->rates[k] : now.rate, 1e-14) << row;
    EXPECT_NEAR(rate, (gap(after, row) - gap(before, row)) / (2 * h), 2e-7) << row;
    EXPECT_NEAR(along(a, b, row, kA.acceleration, Vec3::Zero(), kB.acceleration, Vec3::Zero()) + bias,
                (gap(after, row) - 2 * gap(now, row) + gap(before, row)) / (h * h), 2e-6)
        << row;
  }
}

TEST(JointRows, ofAPointAreTheDerivativesOfItsPlace) {
  expectDerivatives(Joint::Kind::kBall, JointPart::kPoint, ContactFeature::Kind::kJoint, 3);
}

TEST(JointRows, ofASliderAreTheDerivativesOfItsWayAcross) {
  expectDerivatives(Joint::Kind::kSlider, JointPart::kPoint, ContactFeature::Kind::kJoint, 2);
}

TEST(JointRows, ofTurningAreTheDerivativesOfTheCosines) {
  expectDerivatives(Joint::Kind::kHinge, JointPart::kTurning, ContactFeature::Kind::kJoint, 2);
  expectDerivatives(Joint::Kind::kFixed, JointPart::kTurning, ContactFeature::Kind::kJoint, 3);
}

TEST(JointRows, ofARodAndARopeAreTheDerivativesOfTheDistance) {
  expectDerivatives(Joint::Kind::kRod, JointPart::kLength, ContactFeature::Kind::kJoint, 1);
  expectDerivatives(Joint::Kind::kRope, JointPart::kLength, ContactFeature::Kind::kJointEnd, 1);
}

TEST(JointRows, ofASlidersEndsAreTheDerivativesOfItsWay) {
  expectDerivatives(Joint::Kind::kSlider, JointPart::kLowest, ContactFeature::Kind::kJointEnd, 1);
  expectDerivatives(Joint::Kind::kSlider, JointPart::kHighest, ContactFeature::Kind::kJointEnd, 1);
}

// A hinge whose axes agree: a turns about b's axis, by hand at 2 rad/s, while both turn together.
TEST(JointRows, ofAHingesEndsAreTheDerivativesOfItsAngle) {
  Joint joint = jointOf(Joint::Kind::kHinge);
  joint.from.axes = joint.to.axes = Mat3::Identity();
  for (const JointPart part : {JointPart::kLowest, JointPart::kHighest}) {
    const ContactFeature feature{
        .kind = ContactFeature::Kind::kJointEnd, .a = 0, .b = 1, .joint = &joint, .part = part};
    const auto at = [&](double t) {
      const Kinematics b = kB.at(t);
      Kinematics a = b;
      a.pose.worldFromBody = b.pose.worldFromBody * axisAngle(Vec3::UnitZ(), 0.2 + 2 * t);
      a.angularVelocity = b.angularVelocity + 2 * b.pose.worldFromBody.col(2);
      return jointState(feature, a, {kHalvesOfA}, b, {kHalvesOfB});
    };
    const double length = std::min(kHalvesOfA.norm(), kHalvesOfB.norm());
    const double sign = part == JointPart::kLowest ? 1 : -1;
    const ContactState now = at(0);
    EXPECT_NEAR(now.gap, length * (part == JointPart::kLowest ? 0.2 + 0.4 : 0.6 - 0.2), 1e-14);
    EXPECT_NEAR(now.rate, sign * length * 2, 1e-14);
    // ω̇_a − ω̇_b = ω_b × 2 z: the row on that and the bias are the angle's second derivative, none.
    const Vec3 turning = kB.spin.cross(2 * kB.attitude.col(2));
    EXPECT_NEAR(now.rows->a.turning[0].dot(turning) + now.gapBias, 0, 1e-13);
  }
}

// The row of the lower limit, in whose place it stands, but a rate that is relative to the one that it keeps;
// forces of a hinge's row are torques over the length that makes angles metres.
TEST(JointRows, ofAGripAreThoseOfItsCoordinate) {
  for (const Joint::Kind kind : {Joint::Kind::kHinge, Joint::Kind::kSlider}) {
    Joint joint = jointOf(kind);
    joint.grip = 6;
    joint.keptRate = 0.5;
    const auto now = [&](ContactFeature::Kind of, JointPart part) {
      return stateAt({.kind = of, .a = 0, .b = 1, .joint = &joint, .part = part}, 0);
    };
    const ContactState grip = now(ContactFeature::Kind::kJointGrip, JointPart::kGrip);
    const ContactState limit = now(ContactFeature::Kind::kJointEnd, JointPart::kLowest);
    const ContactFrame frame = frameOf(limit.normal);
    const double length = kind == Joint::Kind::kHinge ? std::min(kHalvesOfA.norm(), kHalvesOfB.norm()) : 1;
    EXPECT_EQ(grip.grip, 6 / length);
    EXPECT_EQ(grip.kept, 0.5 * length);
    EXPECT_NEAR(grip.rate, limit.rate - 0.5 * length, 1e-15);
    EXPECT_EQ(grip.gap, 0);
    EXPECT_NEAR(grip.rows->biases[0], limit.gapBias, 1e-14);
    for (const auto& [own, other] :
         {std::pair(grip.rows->a, limit.sideA(frame)), std::pair(grip.rows->b, limit.sideB(frame))}) {
      EXPECT_LE((own.linear[0] - other.linear[0]).norm(), 1e-15);
      EXPECT_LE((own.turning[0] - other.turning[0]).norm(), 1e-15);
      EXPECT_EQ(own.turning[1], Vec3(0, 0, 0));
    }
  }
}

TEST(JointFeatures, areThoseOfJointsThatHaveNotLetGo) {
  World world = floorless();
  world.joints[0].until = 2;
  const auto placeOf = [](const JointEnd& end) { return end.body ? *end.body : 7; };
  EXPECT_EQ(jointFeatures(world, 1.99, placeOf).size(), 4U);
  const std::vector<ContactFeature> later = jointFeatures(world, 2, placeOf);
  ASSERT_EQ(later.size(), 1U);
  EXPECT_EQ(later[0].kind, ContactFeature::Kind::kJointEnd);
  EXPECT_EQ(later[0].part, JointPart::kLength);
  EXPECT_EQ(later[0].a, 1);
  EXPECT_EQ(later[0].b, 7);
  EXPECT_EQ(later[0].material.restitution, 0.5);
}

TEST(JointFeatures, leaveOutJointsOfWhichAnEndIsMissing) {
  const World world = floorless();
  const auto only = [](const JointEnd& end) { return end.body == 0 ? 0 : -1; };
  EXPECT_TRUE(jointFeatures(world, 0, only).empty());
}

}  // namespace
}  // namespace careen
