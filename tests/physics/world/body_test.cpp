#include "physics/world/body.h"

#include <cmath>
#include <limits>
#include <set>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/math/rotation.h"
#include "physics/world/kinematics.h"
#include "support/article_equations.h"

namespace careen {
namespace {

const Vec3 kHalf(0.1, 0.2, 0.3);
const Mat3 kTurned = axisAngle(Vec3(2, -1, 2) / 3, 1.1);

// Full sizes 2, 4, 6 m and 12 kg: Ī = diag(16+36, 4+36, 4+16).
TEST(SolidBox, hasTheInertiaWorkedOutByHand) {
  const MassProperties box = solidBox({1, 2, 3}, 12);
  EXPECT_EQ(box.mass, 12);
  EXPECT_EQ(box.inverseMass, 1.0 / 12);
  EXPECT_EQ(box.inertiaBody, Vec3(52, 40, 20));
  EXPECT_EQ(box.inverseInertiaBody, Vec3(1.0 / 52, 1.0 / 40, 1.0 / 20));
}

// Eq. 19 as the sum it is. n point masses along each edge of a cell grid have Σx² = (a²/12)(1 − 1/n²), so
// that the grid's inertia is the solid's times that factor, exactly.
TEST(SolidBox, isAGridOfPointMassesRefined) {
  constexpr int kGrid = 20;
  constexpr double kMass = 2.5;
  std::vector<PointMass> points;
  for (int i = 0; i < kGrid * kGrid * kGrid; ++i) {
    const int row = i / kGrid;
    const int layer = row / kGrid;
    const Vec3 cell(i % kGrid, row % kGrid, layer);
    const Vec3 unit = (cell + Vec3::Constant(0.5)) * 2 / kGrid - Vec3::Ones();
    points.push_back({.mass = kMass / (kGrid * kGrid * kGrid), .r = unit.cwiseProduct(kHalf)});
  }
  const Mat3 solid = solidBox(kHalf, kMass).inertiaBody.asDiagonal();
  const Mat3 expected = (1 - 1.0 / (kGrid * kGrid)) * solid;
  EXPECT_LT((inertia(points) - expected).norm() / solid.norm(), 1e-13);  // measured 1.6e-14
}

TEST(SolidBox, refusesWhatIsNoBox) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(solidBox(kHalf, 0), InputError);
  EXPECT_THROW(solidBox(kHalf, -1), InputError);
  EXPECT_THROW(solidBox(kHalf, kInfinity), InputError);
  EXPECT_THROW(solidBox({1, 0, 1}, 1), InputError);
  EXPECT_THROW(solidBox({1, kInfinity, 1}, 1), InputError);
}

TEST(Immovable, cannotBeMoved) {
  EXPECT_TRUE(isImmovable(immovable()));
  EXPECT_FALSE(isImmovable(solidBox(kHalf, 1)));
  EXPECT_EQ(inverseInertiaWorld(immovable(), kTurned), Mat3::Zero());
}

TEST(MassProperties, areEqualIfEveryNumberIs) {
  const MassProperties box = solidBox(Vec3(1, 2, 3), 4);
  EXPECT_EQ(box, solidBox(Vec3(1, 2, 3), 4));
  MassProperties other = box;
  other.mass = 5;
  EXPECT_NE(box, other);
  other = box;
  other.inverseMass = 5;
  EXPECT_NE(box, other);
  other = box;
  other.inertiaBody.z() = 5;
  EXPECT_NE(box, other);
  other = box;
  other.inverseInertiaBody.x() = 5;
  EXPECT_NE(box, other);
}

TEST(Touching, takesTheLivelierRestitutionAndTheMeanFriction) {
  const Material pair =
      touching({.restitution = 0.2, .friction = 0.9}, {.restitution = 0.7, .friction = 0.4});
  EXPECT_EQ(pair.restitution, 0.7);
  EXPECT_NEAR(pair.friction, 0.6, 2e-16);  // sqrt(0.9 · 0.4), measured 1.1e-16
  EXPECT_EQ(touching({.restitution = 0, .friction = 0}, {.restitution = 0.5, .friction = 1}).friction, 0);
}

// The surface of b as seen from a, whichever is which.
TEST(Touching, tellsHowTheSurfacesMove) {
  const Material belt{.surface = {.velocity = Vec3(1, 2, 0), .spin = Vec3(0, 0, 3)}};
  EXPECT_EQ(touching({}, belt).surface.velocity, Vec3(1, 2, 0));
  EXPECT_EQ(touching(belt, {}).surface.velocity, Vec3(-1, -2, 0));
  EXPECT_EQ(touching(belt, {}).surface.spin, Vec3(0, 0, -3));
  EXPECT_EQ(swapped(touching({}, belt)).surface.velocity, touching(belt, {}).surface.velocity);
  EXPECT_FALSE(touching({}, {}).surface.moves());
  // At (1, 1, 5) the spin adds (−3, 3, 0); the normal's part is left out.
  EXPECT_EQ(belt.surface.along(Vec3::UnitZ(), Vec3(1, 1, 5)), Vec3(-2, 5, 0));
  EXPECT_EQ(belt.surface.along(Vec3::UnitX(), Vec3(1, 1, 5)), Vec3(0, 5, 0));
}

// Eq. 20 by hand: a quarter turn about z exchanges the moments about x and y.
TEST(InverseInertiaWorld, turnsWithTheBody) {
  const Mat3 quarter = axisAngle(Vec3::UnitZ(), std::acos(0.0));
  const Mat3 expected = Vec3(1.0 / 40, 1.0 / 52, 1.0 / 20).asDiagonal();
  EXPECT_LT((inverseInertiaWorld(solidBox({1, 2, 3}, 12), quarter) - expected).norm(),
            1e-17);  // measured 5e-19
}

// Eqs. 17, 19, 20: the inverse of A Ī Aᵀ.
TEST(InverseInertiaWorld, invertsTheWorldInertia) {
  const MassProperties box = solidBox({1, 2, 3}, 12);
  const Mat3 inertiaWorld = similarityTransform(kTurned, box.inertiaBody.asDiagonal());
  const Mat3 product = inverseInertiaWorld(box, kTurned) * inertiaWorld;
  EXPECT_LT((product - Mat3::Identity()).norm(), 2e-15);  // measured 5.3e-16
}

TEST(AngularMomentum, isInertiaTimesAngularVelocityByHand) {
  EXPECT_EQ(angularMomentum(solidBox({1, 2, 3}, 12), Mat3::Identity(), {1, 2, 3}), Vec3(52, 80, 60));
}

// Eq. 17: Σ r × m (ω × r) over the turned points of the body, against A Ī Aᵀ ω. Eight masses at the corners
// of a box of half sizes s have the inertia of a solid one of half sizes √3 s.
TEST(AngularMomentum, isWhatThePointsOfTheBodyAddUpTo) {
  std::vector<PointMass> corners;
  corners.reserve(kCorners);
  for (int c = 0; c < kCorners; ++c) {
    corners.push_back({.mass = 0.25, .r = kTurned * corner(kHalf, c)});
  }
  const MassProperties box = solidBox(std::sqrt(3.0) * kHalf, 2);
  const Vec3 omega(1, -2, 0.5);
  const Vec3 sum = angularMomentum(corners, omega);
  EXPECT_LT((sum - angularMomentum(box, kTurned, omega)).norm(), 1e-15);  // measured 2e-16
  EXPECT_LT((inertia(corners) * omega - sum).norm(), 1e-15);              // measured 6.5e-17
}

// Eq. 18.
TEST(AngularVelocity, comesBackFromAngularMomentum) {
  const MassProperties box = solidBox(kHalf, 2);
  const Vec3 omega(1, -2, 0.5);
  BodyState state;
  state.pose.worldFromBody = kTurned;
  state.angularMomentum = angularMomentum(box, kTurned, omega);
  EXPECT_LT((angularVelocity(box, state) - omega).norm(), 2e-15);  // measured 5.2e-16
  const Vec3 byEquation20 = inverseInertiaWorld(box, kTurned) * state.angularMomentum;
  EXPECT_LT((angularVelocity(box, state) - byEquation20).norm(), 2e-15);  // measured 2.5e-16
}

TEST(Corner, countsFromPlusWithXSlowest) {
  EXPECT_EQ(corner(kHalf, 0), Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ(corner(kHalf, 1), Vec3(0.1, 0.2, -0.3));
  EXPECT_EQ(corner(kHalf, 2), Vec3(0.1, -0.2, 0.3));
  EXPECT_EQ(corner(kHalf, 4), Vec3(-0.1, 0.2, 0.3));
  EXPECT_EQ(corner(kHalf, 7), Vec3(-0.1, -0.2, -0.3));
}

TEST(Corner, visitsAllEight) {
  std::set<std::tuple<double, double, double>> seen;
  for (int c = 0; c < kCorners; ++c) {
    const Vec3 at = corner(kHalf, c);
    seen.insert({at.x(), at.y(), at.z()});
  }
  EXPECT_EQ(seen.size(), 8U);
}

// Two cubes glued face to face share four corners, which count once; a bar through a plate keeps its ends.
TEST(SetParts, listsTheCornersThatMayTouchAWall) {
  Body glued;
  setParts(glued, {{.halfExtents = Vec3::Ones()}, {.halfExtents = Vec3::Ones(), .center = Vec3(2, 0, 0)}});
  EXPECT_EQ(glued.cornerCount(), 12);
  EXPECT_EQ(glued.halfExtents, Vec3(3, 1, 1));
  Body through;
  setParts(through, {{.halfExtents = Vec3(1, 1, 0.1)}, {.halfExtents = Vec3(0.1, 0.1, 0.5)}});
  EXPECT_EQ(through.cornerCount(), 16);
  EXPECT_EQ(through.thinnest(), 0.1);
  Body within;
  setParts(within, {{.halfExtents = Vec3(0.1, 0.1, 0.1)}, {.halfExtents = Vec3(1, 1, 1)}});
  EXPECT_EQ(within.cornerCount(), 8);
  for (int k = 0; k < kCorners; ++k) {
    EXPECT_EQ(corner(within, k), corner(Vec3::Ones(), k));
  }
}

TEST(SetParts, turnsPartsAboutTheBody) {
  Body body;
  body.boxCenter = Vec3(0, 0, 1);
  const Mat3 quarter = axisAngle(Vec3::UnitZ(), std::acos(0.0));
  const BodyPart bar{
      .halfExtents = Vec3(2, 0.5, 0.25), .center = Vec3(1, 0, 0), .turned = true, .bodyFromPart = quarter};
  setParts(body, {bar});
  EXPECT_LT((body.part(0).middle() - Vec3(0, 1, 0)).norm(), 1e-15);
  EXPECT_LT((body.halfExtents - Vec3(0.5, 3, 1.25)).norm(), 1e-15);
  const Pose box{.position = Vec3(5, 6, 7), .worldFromBody = kTurned};
  const Pose middle = partPose(body, 0, box);
  EXPECT_LT((middle.position - box.worldPoint(Vec3(0, 1, -1))).norm(), 2e-15);
  EXPECT_LT((middle.worldFromBody - kTurned * quarter).norm(), 1e-15);
  EXPECT_LT(bar.seenFrom(Vec3(0, 1, 0)).middle().norm(), 1e-15);
}

}  // namespace
}  // namespace careen
