#include "physics/contact/contact_feature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "support/article_equations.h"

namespace careen {
namespace {

const Vec3 kHalfA(0.3, 0.2, 0.1);
const Vec3 kHalfB(0.25, 0.4, 0.35);

// A body that turns steadily about a fixed axis while its centre runs along a parabola: known at any moment.
struct Path {
  Vec3 position;
  Vec3 velocity;
  Vec3 acceleration;
  Vec3 axis;
  double speed = 0;
  Mat3 attitude;

  Kinematics at(double t) const {
    return {
        {Vec3(position + velocity * t + 0.5 * t * t * acceleration), axisAngle(axis, speed * t) * attitude},
        velocity + t * acceleration,
        speed * axis};
  }
};

const Path kPathA{Vec3(0.1, -0.2, 0.5),
                  Vec3(0.3, 0.1, -0.2),
                  Vec3(0.2, -0.5, 0.4),
                  Vec3(1, 2, -0.5).normalized(),
                  1.3,
                  axisAngle(Vec3(1, 1, 0).normalized(), 0.7)};
const Path kPathB{Vec3(-0.2, 0.1, 0.0),
                  Vec3(-0.1, 0.2, 0.1),
                  Vec3(-0.3, 0.1, 0.2),
                  Vec3(-0.3, 1, 1).normalized(),
                  -0.9,
                  axisAngle(Vec3(0, 1, 1).normalized(), -0.4)};

// gap, its rate and the bias against differences of the gap itself: neither ω̇ is there to add.
void expectDerivatives(const ContactFeature& feature, const Wall* wall) {
  const auto state = [&](double t) {
    const Kinematics a = kPathA.at(t);
    const Kinematics b = kPathB.at(t);
    return contactState(feature, a, {kHalfA}, b, {.halfExtents = kHalfB, .halfSpace = wall});
  };
  const double h = 1e-4;
  const ContactState now = state(0);
  const Vec3 pull = wall == nullptr ? Vec3(kPathA.acceleration - kPathB.acceleration) : kPathA.acceleration;
  EXPECT_NEAR(now.rate, (state(h).gap - state(-h).gap) / (2 * h), 1e-7);
  EXPECT_NEAR(now.normal.dot(pull) + now.gapBias, (state(h).gap - 2 * now.gap + state(-h).gap) / (h * h),
              2e-6);
}

TEST(ContactState, ofACornerOnAWallChangesAsItSays) {
  const Wall wall{.name = "wall", .normal = Vec3(1, -2, 2) / 3, .offset = -0.2, .material = {}};
  expectDerivatives({.a = 0, .onA = corner(kHalfA, 5)}, &wall);
}

// On a turntable: its slip is relative to the surface where the corner is, and changes as it says.
TEST(ContactState, slipsOnWhatMovesAlongItself) {
  const Wall wall{.name = "wall", .normal = Vec3(1, -2, 2) / 3, .offset = -0.2, .material = {}};
  const SurfaceMotion surface{.velocity = Vec3(2, 1, 0), .spin = 3 * wall.normal};
  ContactFeature feature{.a = 0, .onA = corner(kHalfA, 5)};
  const auto state = [&](double t) {
    const Kinematics a = kPathA.at(t);
    return contactState(feature, a, {kHalfA}, {}, {.halfExtents = kHalfB, .halfSpace = &wall});
  };
  const ContactState before = state(0);
  feature.material.surface = surface;
  const ContactState now = state(0);
  const Vec3 point = kPathA.at(0).pose.position + now.armA;
  const Vec3 due = Vec3(2, 1, 0) + 3 * wall.normal.cross(point);
  EXPECT_LT((now.slip + (due - wall.normal.dot(due) * wall.normal) - before.slip).norm(), 1e-14);
  EXPECT_EQ(now.rate, before.rate);
  EXPECT_EQ(now.gapBias, before.gapBias);
  const double h = 1e-4;
  const Vec3 change = (state(h).slip - state(-h).slip) / (2 * h);
  const Vec3 said = kPathA.acceleration + now.slipBias;
  EXPECT_LT((change - (said - wall.normal.dot(said) * wall.normal)).norm(), 2e-8);  // measured 4e-9
}

TEST(ContactState, ofACornerOnATurningFaceChangesAsItSays) {
  expectDerivatives({.kind = ContactFeature::Kind::kPointOnFace,
                     .a = 0,
                     .b = 1,
                     .onA = corner(kHalfA, 3),
                     .axisB = 1,
                     .sign = -1},
                    nullptr);
}

// The crossing is brought to touch first: apart from each other, the gap's second derivative has a term more.
TEST(ContactState, ofTwoEdgesChangesAsItSays) {
  const ContactFeature feature{.kind = ContactFeature::Kind::kEdgeOnEdge,
                               .a = 0,
                               .b = 1,
                               .onA = Vec3(0, -kHalfA.y(), -kHalfA.z()),
                               .onB = Vec3(kHalfB.x(), 0, kHalfB.z()),
                               .axisA = 0,
                               .axisB = 1};
  const auto state = [&](double t, const Vec3& shift) {
    Kinematics a = kPathA.at(t);
    a.pose.position += shift;
    const Kinematics b = kPathB.at(t);
    return contactState(feature, a, {kHalfA}, b, {kHalfB});
  };
  const ContactState apart = state(0, Vec3::Zero());
  const Vec3 shift = -apart.gap * apart.normal;
  const ContactState now = state(0, shift);
  ASSERT_NEAR(now.gap, 0, 1e-15);
  const double h = 1e-4;
  EXPECT_NEAR(now.rate, (state(h, shift).gap - state(-h, shift).gap) / (2 * h), 1e-7);
  EXPECT_NEAR(now.normal.dot(kPathA.acceleration - kPathB.acceleration) + now.gapBias,
              (state(h, shift).gap + state(-h, shift).gap) / (h * h), 2e-6);
  EXPECT_NEAR((now.armA - now.armB + kPathA.position + shift - kPathB.position).norm(), 0, 1e-15);
}

// In a cone, for a corner of a that moves along an edge of b, for the reverse, and for two corners: gap,
// rate, and the rate of the slip. The points are brought to touch first, as above.
TEST(ContactState, inAConeChangesAsItSays) {
  ContactFeature feature{.kind = ContactFeature::Kind::kInCone,
                         .a = 0,
                         .b = 1,
                         .normalA = Vec3(0.3, -0.5, 0.8).normalized(),
                         .normalB = Vec3(0.1, 0.9, 0.4).normalized()};
  const int none = ContactFeature::kNoEdge;
  for (const auto& [axisA, axisB] : {std::pair{none, 1}, std::pair{2, none}, std::pair{none, none}}) {
    feature.axisA = axisA;
    feature.axisB = axisB;
    feature.onA = corner(kHalfA, 3);
    feature.onB = corner(kHalfB, 6);
    Vec3 along = Vec3::Zero();
    if (axisA != none) {
      feature.onA[axisA] = 0;
      along = -0.05 * kPathA.at(0).pose.worldFromBody.col(axisA);
    }
    if (axisB != none) {
      feature.onB[axisB] = 0;
      along = 0.1 * kPathB.at(0).pose.worldFromBody.col(axisB);
    }
    Vec3 shift = Vec3::Zero();
    Vec3 drift = Vec3::Zero();
    const auto state = [&](double t) {
      Kinematics a = kPathA.at(t);
      a.pose.position += shift + t * drift;
      a.velocity += drift;
      const Kinematics b = kPathB.at(t);
      return contactState(feature, a, {kHalfA}, b, {kHalfB});
    };
    shift = kPathB.position + kPathB.attitude * feature.onB + along - kPathA.position -
            kPathA.attitude * feature.onA;
    const ContactState now = state(0);
    ASSERT_NEAR(now.gap, 0, 1e-15);
    ASSERT_NEAR(now.offset.norm(), 0, 1e-15);
    const double h = 1e-4;
    EXPECT_NEAR(now.rate, (state(h).gap - state(-h).gap) / (2 * h), 1e-7);
    const Vec3 pull = kPathA.acceleration - kPathB.acceleration;
    EXPECT_NEAR(now.normal.dot(pull) + now.gapBias, (state(h).gap + state(-h).gap) / (h * h), 2e-6);
    EXPECT_NEAR((now.armA - now.armB + kPathA.position + shift - kPathB.position).norm(), 0, 1e-15);
    if (axisA == none && axisB == none) {
      continue;
    }
    const Vec3 edge = axisA != none ? kPathA.attitude.col(axisA) : kPathB.attitude.col(axisB);
    EXPECT_NEAR(now.normal.dot(edge), 0, 1e-15);
    // Along the edge, and only there, they may go on slipping.
    const auto relative = [&](double t) { return Vec3(state(t).slip + state(t).rate * state(t).normal); };
    drift = 0.3 * edge - relative(0);
    const Vec3 slipRate = (relative(h) - relative(-h)) / (2 * h);
    EXPECT_NEAR((pull + state(0).slipBias - slipRate).norm(), 0, 1e-7);
  }
}

// Two cubes edge on edge, head on. Both turned about the edge by φ and −ψ, the fan's sides are one face of
// each: its bisector has turned by (φ − ψ)/2. It is left when the edges part sideways, and when it leaves
// the cone: the fan closes at φ + ψ = 90°.
TEST(FeatureAt, ofEdgesInAConeKeepsTheBisector) {
  const Vec3 half(0.5, 0.5, 0.5);
  const double eighth = std::acos(-1.0) / 4;
  const Mat3 onEdge = axisAngle(Vec3::UnitY(), eighth);
  const double reach = std::sqrt(0.5);
  const auto turned = [&](double angle, double side) {
    Kinematics at;
    at.pose.worldFromBody = axisAngle(Vec3::UnitY(), angle) * onEdge;
    at.pose.position = axisAngle(Vec3::UnitY(), angle) * Vec3(side * reach, 0, 0);
    return at;
  };
  const Pose a = turned(0, 1).pose;
  const Pose b = turned(0, -1).pose;
  const ContactPoints points = boxContactPoints({a, half}, {b, half});
  ASSERT_EQ(points.size(), 2U);
  for (const ContactPoint& point : points) {
    const ContactFeature feature = featureAt(point, 0, 0, {a, half}, 1, {b, half});
    ASSERT_EQ(feature.kind, ContactFeature::Kind::kInCone);
    for (const auto& [phi, psi] : {std::pair{0.3, -0.1}, std::pair{0.0, 0.7}, std::pair{-0.4, 0.2}}) {
      const Kinematics ofB = turned(-psi, -1);
      const ContactState state = contactState(feature, turned(phi, 1), {half}, ofB, {half});
      const Vec3 bisector = axisAngle(Vec3::UnitY(), (phi - psi) / 2) * Vec3::UnitX();
      EXPECT_NEAR((state.normal - bisector).norm(), 0, 1e-15);
      EXPECT_NEAR(state.gap, 0, 1e-15);
      EXPECT_LT(state.beyond, 1e-15);
    }
    const Kinematics ofB = turned(-0.8, -1);
    EXPECT_GT(contactState(feature, turned(0.8, 1), {half}, ofB, {half}).beyond, 1e-3);
    Kinematics aside = turned(0, 1);
    aside.pose.position.z() += 1e-9;
    const Kinematics straight = turned(0, -1);
    EXPECT_NEAR(contactState(feature, aside, {half}, straight, {half}).beyond, 1e-9, 1e-15);
  }
}

// A small box flat on a large one, half over its border: two corners stand on the face, and two pairs of
// edges cross.
TEST(FeatureAt, tellsCornersOnFacesFromCrossings) {
  const Pose a{.position = Vec3(0.25, 0, 0.45), .worldFromBody = Mat3::Identity()};
  const Pose b{};
  int corners = 0;
  int crossings = 0;
  for (const ContactPoint& point : boxContactPoints({a, kHalfA}, {b, kHalfB})) {
    const ContactFeature feature = featureAt(point, 0, 0, {a, kHalfA}, 1, {b, kHalfB});
    corners += feature.kind == ContactFeature::Kind::kPointOnFace ? 1 : 0;
    crossings += feature.kind == ContactFeature::Kind::kEdgeOnEdge ? 1 : 0;
  }
  EXPECT_EQ(corners, 2);
  EXPECT_EQ(crossings, 2);
}

}  // namespace
}  // namespace careen
