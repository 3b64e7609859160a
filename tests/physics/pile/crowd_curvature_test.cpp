// Gaps at the ends of steps where bodies turn: right to third order in the step, so far below what corners
// leave their tangents by, r ω² h²/2.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "physics/geometry/separation.h"
#include "physics/pile/crowd.h"
#include "support/crates.h"
#include "support/crowd_stages.h"
#include "support/parts.h"
#include "support/pile_scenes.h"

namespace careen {
namespace {

Body spinningBox(const Vec3& half, const Vec3& position, const Quat& attitude, const Vec3& velocity,
                 const Vec3& spin) {
  Body body;
  body.halfExtents = half;
  body.mass = solidBox(half, 8000 * half.prod());
  body.material = {.restitution = 0, .friction = 0.9};
  body.initial.pose = {.position = position, .worldFromBody = attitude.toRotationMatrix()};
  body.initial.velocity = velocity;
  const Vec3 spinBody = attitude.conjugate() * spin;
  body.initial.angularMomentum = attitude * Vec3(body.mass.inertiaBody.cwiseProduct(spinBody));
  return body;
}

// The corners of a cube that spins about a horizontal axis are drawn to it: up, by ω² × 0.25 m, whether they
// go up or down. Two of them come down by 5.6 mm in the step, to 0.3 mm: nothing is pushed.
TEST(CrowdCurvature, cornersBelowTheAxisRiseByHalfTheirAccelerationTimesStepSquared) {
  const double h = 1.0 / 180;
  const double spin = 4;
  World world = test::floorWorld({});
  world.gravity = Vec3::Zero();
  world.bodies.push_back(spinningBox(Vec3::Constant(0.25), Vec3(0, 0, 0.25 + 5.9e-3), Quat::Identity(),
                                     Vec3::Zero(), Vec3(0, spin, 0)));
  test::CrowdStages stages(world);
  stages.meet(h);
  stages.impulses.find();
  EXPECT_FALSE(stages.impulses.solver().pushed(0));
  int rows = 0;
  for (int k = 0; k < stages.manifold().count; ++k) {
    const PilePoint& point = stages.manifold().points[at(k)];
    if (point.row >= 0) {
      EXPECT_NEAR(point.curved, 0.5 * h * h * spin * spin * 0.25, 1e-12);
      ++rows;
    }
  }
  EXPECT_EQ(rows, 4);
}

// A cube tips over one of its edges, held to the floor by gravity.
TEST(CrowdCurvature, edgeThatACubeTipsOverStaysOnTheFloor) {
  const double spin = 5;
  const double tilt = 0.3;  // [rad] of the diagonal from the vertical
  const double radius = std::sqrt(0.5);
  World world;
  world.gravity = Vec3(0, 0, -100);
  world.walls.push_back({.name = "floor", .material = {.restitution = 0, .friction = 0.9}});
  const Vec3 arm(radius * std::sin(tilt), 0, radius * std::cos(tilt));  // from the edge to the centre
  const Vec3 turning(0, spin, 0);
  const Quat attitude(Eigen::AngleAxisd(std::numbers::pi / 4 + tilt, Vec3::UnitY()));
  world.bodies.push_back(spinningBox(Vec3::Constant(0.5), arm, attitude, turning.cross(arm), turning));

  const double tolerance = Crowd::kUsualTolerance;
  Crowd crowd(world, tolerance);
  const std::size_t place = crowd.admit(0, world.bodies[0].initial, attitude);
  const auto gap = [&] {
    const BoxAt at{
        .pose = crowd.state(place).pose, .halfExtents = world.bodies[0].halfExtents, .center = Vec3::Zero()};
    return gapToPlane(at, Vec3::UnitZ(), 0);
  };
  double before = gap();
  int steps = 0;
  for (;; ++steps) {
    const double h = crowd.step(1);
    if (crowd.state(place).pose.position.z() < 0.53) {
      break;  // soon its face meets the floor
    }
    const double leaves = 0.5 * h * h * radius * crowd.body(place).omega.squaredNorm();
    EXPECT_GT(leaves, 0.5 * tolerance);
    // Measured 0.016; to first order only 0.95.
    EXPECT_LT(std::abs(gap() - before), 0.03 * leaves) << steps;
    before = gap();
  }
  EXPECT_GE(steps, 10);
}

// Pairs of boxes, without gravity, that spin and meet as they may: faces, edges and corners.
TEST(CrowdCurvature, spinningBoxesThatMeetTouchAtTheEndsOfSteps) {
  const double tolerance = 1e-3;
  test::Pourer dice(7);
  std::vector<double> parts;  // [1] overlap after a step, of what corners leave their tangents by in it
  for (int trial = 0; trial < 400; ++trial) {
    World world;
    const auto add = [&](double side) {
      const Vec3 half = dice.vector(0.2, 0.4);
      const Quat attitude = dice.attitude();
      world.bodies.push_back(spinningBox(half, Vec3(side, 0, 0) + 0.1 * dice.vector(-1, 1), attitude,
                                         Vec3(-2 * side, 0, 0), 12 * dice.vector(-1, 1)));
    };
    add(0.8);
    add(-0.8);
    Crowd crowd(world, tolerance);
    for (std::size_t i = 0; i < world.bodies.size(); ++i) {
      const BodyState& state = world.bodies[i].initial;
      crowd.admit(i, state, Quat(state.pose.worldFromBody));
    }
    for (int k = 0; k < 60; ++k) {
      const double h = crowd.step(1);
      double leaves = 0;
      for (std::size_t i = 0; i < 2; ++i) {
        const PileBody& body = crowd.body(i);
        leaves += 0.5 * h * h * body.radius * body.omega.squaredNorm();
      }
      const double overlap = crowd.penetration();
      if (overlap > 0 && leaves > 0.5 * tolerance) {
        parts.push_back(overlap / leaves);
      }
    }
  }
  std::sort(parts.begin(), parts.end());
  ASSERT_GT(parts.size(), 100U);
  EXPECT_LT(parts[parts.size() / 2], 0.05);      // measured 0.020; to first order only 0.19
  EXPECT_LT(parts[parts.size() * 9 / 10], 0.3);  // 0.19, where other features meet; 0.40
}

// Bars that spin across each other: what their edges' gap leaves its tangent by does not depend on the frame
// in which a bar is given.
TEST(CrowdCurvature, isThatOfBoxesInWhateverFrameTheyAreGiven) {
  const double h = 1.0 / 180;
  test::Pourer dice(11);
  int edges = 0;
  double most = 0;
  double worst = 0;
  for (int trial = 0; trial < 300; ++trial) {
    World plain;
    World turned;
    for (const double side : {-1.0, 1.0}) {
      const Quat attitude = Quat(Quat::Identity().coeffs() + 0.2 * dice.attitude().coeffs()).normalized();
      const Vec3 half = side < 0 ? Vec3(0.5, 0.1, 0.1) : Vec3(0.1, 0.5, 0.1);
      plain.bodies.push_back(spinningBox(half, Vec3(0, 0, 0.125 * side), attitude, Vec3::Zero(),
                                         6 * dice.vector(-1, 1).normalized()));
      turned.bodies.push_back(test::turnedIn(plain.bodies.back(), dice.attitude().toRotationMatrix()));
    }
    test::CrowdStages one(plain);
    test::CrowdStages other(turned);
    for (test::CrowdStages* stages : {&one, &other}) {
      stages->meet(h);
      stages->impulses.find();
    }
    if (one.contacts.near().empty() || !one.manifold().hasEdges || !other.manifold().hasEdges) {
      continue;
    }
    const int k = one.manifold().count - 1;
    const bool isPushed = one.impulses.solver().pushed(0) || other.impulses.solver().pushed(0);
    if (isPushed || other.manifold().count - 1 != k || other.manifold().points[at(k)].row < 0) {
      continue;  // velocities then are those of iterations; points may be just near enough
    }
    if (one.manifold().points[at(k)].row >= 0) {
      const double curved = one.manifold().points[at(k)].curved;
      most = std::max(most, std::fabs(curved));
      worst = std::max(worst, std::fabs(curved - other.manifold().points[at(k)].curved));
      ++edges;
    }
  }
  EXPECT_GT(edges, 30);     // measured 111
  EXPECT_GT(most, 1e-4);    // measured 2.5e-4
  EXPECT_LT(worst, 1e-17);  // measured 1.3e-18
}

}  // namespace
}  // namespace careen
