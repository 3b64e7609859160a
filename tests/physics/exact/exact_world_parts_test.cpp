// Bodies of several boxes: against the one box that they make, against boxes that joints weld, and closed
// forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "physics/simulate.h"
#include "physics/world/given_inertia.h"
#include "support/exact_runs.h"
#include "support/impact_scene.h"
#include "support/parts.h"
#include "support/physics_worlds.h"

namespace careen {
namespace {

using test::Random;
using test::turnedIn;

constexpr double kFallOfParts = 9.81;

// The same body, as eight boxes.
Body inEight(Body body) {
  std::vector<BodyPart> parts;
  for (int k = 0; k < kCorners; ++k) {
    parts.push_back({.halfExtents = 0.5 * body.halfExtents, .center = 0.5 * corner(body.halfExtents, k)});
  }
  setParts(body, std::move(parts));
  return body;
}

World onRoughFloor(std::vector<Body> bodies, double restitution, double friction) {
  World world;
  world.gravity = Vec3(0, 0, -kFallOfParts);
  world.walls = {floorAt(0)};
  world.walls[0].material = {.restitution = restitution, .friction = friction};
  world.bodies = std::move(bodies);
  for (Body& body : world.bodies) {
    body.material = world.walls[0].material;
  }
  return world;
}

double apartAt(const World& world, const Recorded& a, const Recorded& b, double time) {
  double most = 0;
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    const Pose one = a.at(world, i, time).pose;
    const Pose other = b.at(world, i, time).pose;
    most = std::max(
        most, (one.position - other.position).norm() +
                  world.bodies[i].halfExtents.norm() * (one.worldFromBody - other.worldFromBody).norm());
  }
  return most;
}

TEST(ExactWorldParts, inFlightEightBoxesAreTheOneToTheBit) {
  Random random(1);
  for (int k = 0; k < 20; ++k) {
    World whole;
    whole.gravity = Vec3(0, 0, -kFallOfParts);
    whole.bodies = {makeBox({.halfExtents = Vec3(0.1, 0.2, 0.3) + 0.1 * random.inCube(1).cwiseAbs(),
                             .worldFromBody = random.rotation(),
                             .velocity = random.inCube(1),
                             .angularVelocity = 5 * random.inCube(1)})};
    World eight = whole;
    eight.bodies[0] = inEight(whole.bodies[0]);
    const Recorded one = runBy(whole, {.duration = 3});
    const Recorded other = runBy(eight, {.duration = 3});
    const BodyState a = one.last(whole, 0, 3);
    const BodyState b = other.last(whole, 0, 3);
    EXPECT_EQ(a.pose.position, b.pose.position);
    EXPECT_EQ(a.pose.worldFromBody, b.pose.worldFromBody);
    EXPECT_EQ(a.angularMomentum, b.angularMomentum);
  }
}

// Thrown onto a floor: the same impacts, until chaos tells them apart.
TEST(ExactWorldParts, thrownOntoAFloorEightBoxesAreTheOne) {
  Random random(2);
  double worst = 0;
  for (int k = 0; k < 30; ++k) {
    const World whole = onRoughFloor({makeBox({.halfExtents = Vec3(0.1, 0.2, 0.3),
                                               .position = Vec3(0, 0, 1),
                                               .worldFromBody = random.rotation(),
                                               .velocity = random.inCube(1),
                                               .angularVelocity = 3 * random.inCube(1)})},
                                     0.6, 0.4);
    World eight = whole;
    eight.bodies[0] = inEight(whole.bodies[0]);
    worst = std::max(worst,
                     apartAt(whole, runBy(whole, {.duration = 0.7}), runBy(eight, {.duration = 0.7}), 0.7));
  }
  EXPECT_LT(worst, 2e-14);  // measured 7e-15
}

// Boxes that bounce off each other and a floor, and one that slides to rest on it: in whatever frame they are
// given.
TEST(ExactWorldParts, moveAlikeInWhateverFrameTheirBoxIsGiven) {
  Random random(4);
  const auto worstOf = [&](int boxes, double restitution, double duration) {
    double worst = 0;
    for (int k = 0; k < 20; ++k) {
      std::vector<Body> bodies;
      for (int i = 0; i < boxes; ++i) {
        bodies.push_back(makeBox({.halfExtents = Vec3(0.2, 0.15, 0.1),
                                  .position = Vec3(random.between(-0.05, 0.05), 0, 0.3 + 0.6 * i),
                                  .worldFromBody = random.rotation(),
                                  .velocity = Vec3(1, 0, 0),
                                  .angularVelocity = random.inCube(1),
                                  .name = "box " + std::to_string(i)}));
      }
      const World plain = onRoughFloor(bodies, restitution, 0.4);
      World turned = plain;
      for (Body& body : turned.bodies) {
        body = turnedIn(body, random.rotation());
      }
      const Recorded one = runBy(plain, {.duration = duration});
      const Recorded other = runBy(turned, {.duration = duration});
      for (std::size_t i = 0; i < bodies.size(); ++i) {
        const Pose is = partPose(turned.bodies[i], 0, other.at(turned, i, duration).pose);
        const Pose as = one.at(plain, i, duration).pose;
        worst = std::max(worst,
                         (is.position - as.position).norm() + (is.worldFromBody - as.worldFromBody).norm());
      }
    }
    return worst;
  };
  EXPECT_LT(worstOf(3, 0.9, 0.45), 2e-12);  // measured 7e-13
  EXPECT_LT(worstOf(1, 0, 1.5), 1e-5);      // measured 6e-6: contact is right to 1e-6
}

// A table with a box on it stands as a crowd too, and falls asleep; its legs are given lying.
TEST(ExactWorldParts, standInACrowd) {
  Body table = makeBox({.halfExtents = Vec3(0.4, 0.3, 0.3), .position = Vec3(0, 0, 0.3), .name = "table"});
  std::vector<BodyPart> parts{{.halfExtents = Vec3(0.4, 0.3, 0.03), .center = Vec3(0, 0, 0.27)}};
  for (const double x : {-0.35, 0.35}) {
    for (const double y : {-0.25, 0.25}) {
      const Mat3 upright = Quat(Eigen::AngleAxisd(std::acos(0.0), Vec3::UnitY())).toRotationMatrix();
      parts.push_back({.halfExtents = Vec3(0.27, 0.04, 0.04),
                       .center = upright.transpose() * Vec3(x, y, -0.03),
                       .turned = true,
                       .bodyFromPart = upright});
    }
  }
  setParts(table, parts);
  const World world = onRoughFloor(
      {table, makeBox({.halfExtents = Vec3::Constant(0.1), .position = Vec3(0.1, 0, 0.72), .name = "cup"}),
       makeBox({.halfExtents = Vec3::Constant(0.1), .position = Vec3(0, 0, 0.1), .name = "under"})},
      0, 0.5);
  RunSettings settings{.duration = 2};
  settings.crowds = {.when = CrowdSettings::When::kAbove, .above = 0};
  const Recorded run = runBy(world, settings);
  const auto placeOf = [&](std::size_t body) { return run.last(world, body, 2).pose.position; };
  EXPECT_LT((placeOf(0) - Vec3(0, 0, 0.3)).norm(), 1e-9);    // measured 4e-10
  EXPECT_LT((placeOf(1) - Vec3(0.1, 0, 0.7)).norm(), 2e-8);  // measured 9e-9
  EXPECT_EQ(placeOf(2), Vec3(0, 0, 0.1));
  EXPECT_TRUE(std::holds_alternative<Rest>(run.motions[1].back().second));
}

// A block slides down to rest, v²/(2μg), and a stack of two stands: contact, on four boxes at once.
TEST(ExactWorldParts, slideAndStandAsOneBox) {
  World world = onRoughFloor(
      {makeBox({.halfExtents = Vec3(0.3, 0.2, 0.1),
                .position = Vec3(0, 0, 0.1),
                .velocity = Vec3(2, 0, 0),
                .name = "low"}),
       makeBox({.halfExtents = Vec3(0.1, 0.1, 0.1), .position = Vec3(0, 3, 0.1), .name = "base"}),
       makeBox({.halfExtents = Vec3(0.1, 0.1, 0.1), .position = Vec3(0, 3, 0.3), .name = "top"})},
      0, 0.3);
  for (Body& body : world.bodies) {
    body = inEight(body);
  }
  const Recorded run = runBy(world, {.duration = 2});
  EXPECT_NEAR(run.last(world, 0, 2).pose.position.x(), 4 / (2 * 0.3 * kFallOfParts), 1e-9);
  EXPECT_NEAR(run.last(world, 0, 2).pose.position.z(), 0.1, 1e-12);
  EXPECT_LT((run.last(world, 2, 2).pose.position - Vec3(0, 3, 0.3)).norm(), 1e-12);
}

// A bridge on two feet over a cube that slides through beneath it, touching nothing.
TEST(ExactWorldParts, letOthersThroughBetweenTheirBoxes) {
  Body bridge = makeBox({.halfExtents = Vec3(0.5, 0.2, 0.3), .position = Vec3(0, 0, 0.3), .name = "bridge"});
  setParts(bridge, {{.halfExtents = Vec3(0.5, 0.2, 0.05), .center = Vec3(0, 0, 0.25)},
                    {.halfExtents = Vec3(0.05, 0.2, 0.25), .center = Vec3(-0.45, 0, -0.05)},
                    {.halfExtents = Vec3(0.05, 0.2, 0.25), .center = Vec3(0.45, 0, -0.05)}});
  World world = onRoughFloor({bridge, makeBox({.halfExtents = Vec3::Constant(0.2),
                                               .position = Vec3(0, -2, 0.2),
                                               .velocity = Vec3(0, 4, 0),
                                               .name = "cube"})},
                             0, 0);
  const Recorded run = runBy(world, {.duration = 1});
  EXPECT_TRUE(run.impacts.empty() || std::all_of(run.impacts.begin(), run.impacts.end(),
                                                 [](const Impact& impact) { return impact.b.isWall(); }));
  EXPECT_NEAR(run.last(world, 1, 1).pose.position.y(), 2, 1e-12);
  // Higher than the passage it strikes the deck's edge, at the moment that its front is there.
  world.bodies[1].halfExtents = Vec3(0.2, 0.2, 0.27);
  world.bodies[1].initial.pose.position.z() = 0.27;
  const Recorded struck = runBy(world, {.duration = 1});
  const auto first = std::find_if(struck.impacts.begin(), struck.impacts.end(),
                                  [](const Impact& impact) { return !impact.b.isWall(); });
  ASSERT_NE(first, struck.impacts.end());
  EXPECT_NEAR(first->time, (2 - 0.2 - 0.2) / 4, 1e-12);
}

// A cube that slides over one box of a body strikes another one of it, at the moment that it is there.
TEST(ExactWorldParts, whatLiesOnOneOfTheirBoxesStrikesAnother) {
  Body corner = makeBox({.halfExtents = Vec3(1, 0.3, 0.3), .position = Vec3(0, 0, 0.3), .density = 10});
  setParts(corner, {{.halfExtents = Vec3(1, 0.3, 0.05), .center = Vec3(0, 0, -0.25)},
                    {.halfExtents = Vec3(0.05, 0.3, 0.25), .center = Vec3(0.95, 0, 0.05)}});
  const World world = onRoughFloor({corner, makeBox({.halfExtents = Vec3::Constant(0.1),
                                                     .position = Vec3(-0.5, 0, 0.2),
                                                     .velocity = Vec3(1, 0, 0),
                                                     .name = "cube"})},
                                   0, 0);
  const Recorded run = runBy(world, {.duration = 1.5});
  const auto first = std::find_if(run.impacts.begin(), run.impacts.end(), [](const Impact& impact) {
    return !impact.b.isWall() && std::fabs(impact.normal.x()) > 0.5;
  });
  ASSERT_NE(first, run.impacts.end());
  EXPECT_NEAR(first->time, 0.9 - 0.1 + 0.5, 1e-14);  // measured 7e-16
  EXPECT_NEAR(first->approach, 1, 1e-9);
}

// What stands on a foot tips where its centre of mass is a millimetre beyond it, and stands a millimetre
// within.
TEST(ExactWorldParts, tipWhereTheirCentreOfMassIsBeyondTheirFoot) {
  for (const double shift : {-0.001, 0.001}) {
    Body hanger;
    hanger.name = "hanger";
    hanger.mass = massWithInertia(10, Vec3(1, 1, 1));
    hanger.initial.pose.position = Vec3(0, 0, 0.5);
    const Vec3 foot(-0.25 - shift, 0, -0.45);  // its edge is under the centre of mass, but for the shift
    setParts(hanger, {{.halfExtents = Vec3(0.25, 0.2, 0.05), .center = foot},
                      {.halfExtents = Vec3(0.05, 0.05, 0.5), .center = Vec3(-0.25 - shift, 0, 0)},
                      {.halfExtents = Vec3(0.5, 0.05, 0.05), .center = Vec3(0.2, 0, 0.45)}});
    const World world = onRoughFloor({hanger}, 0, 1);
    const Recorded run = runBy(world, {.duration = 0.5});
    const double lean = run.last(world, 0, 0.5).pose.worldFromBody(2, 0);
    if (shift < 0) {
      EXPECT_EQ(lean, 0);
    } else {
      // To first order (shift / h)(cosh λt − 1), λ² = m g h / I about the foot's edge, h = ½ m.
      const double rate = std::sqrt(10 * kFallOfParts * 0.5 / (1 + 10 * (0.25 + shift * shift)));
      EXPECT_NEAR(std::fabs(lean), shift / 0.5 * (std::cosh(rate * 0.5) - 1), 4e-8);  // measured 1.9e-8
    }
  }
}

// Two boxes welded by a joint are the same body, by other equations: in flight and through impacts on a
// floor.
TEST(ExactWorldParts, moveAsBoxesThatAJointWelds) {
  Random random(3);
  double worst = 0;
  for (int k = 0; k < 20; ++k) {
    const Vec3 half(0.1, 0.15, 0.2);
    const Vec3 other(0.2, 0.1, 0.1);
    const Vec3 off(0.3, 0.05, -0.1);  // where they touch
    const Mat3 axes = random.rotation();
    const Vec3 spin = 2 * random.inCube(1);
    const Vec3 at(0, 0, 1.2);
    const MassProperties light = solidBox(half, 1);
    const MassProperties heavy = solidBox(other, 2);
    World welded = onRoughFloor(
        {makeBox({.halfExtents = half, .position = at, .worldFromBody = axes}),
         makeBox(
             {.halfExtents = other, .position = at + axes * off, .worldFromBody = axes, .name = "second"})},
        0.5, 0.3);
    welded.bodies[0].mass = light;
    welded.bodies[1].mass = heavy;
    const Vec3 center = off * 2 / 3;
    for (std::size_t i = 0; i < 2; ++i) {
      BodyState& state = welded.bodies[i].initial;
      state.velocity = spin.cross(state.pose.position - (at + axes * center));
      state.angularMomentum = angularMomentum(welded.bodies[i].mass, axes, spin);
    }
    welded.joints = {{.name = "weld",
                      .kind = Joint::Kind::kFixed,
                      .from = {.body = 0, .point = off},
                      .to = {.body = 1, .point = Vec3::Zero()}}};
    welded.apart = {{0, 1}};
    Body both = welded.bodies[0];
    const auto about = [&](const MassProperties& mass, const Vec3& arm) {
      return Mat3(mass.inertiaTensor() +
                  mass.mass * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose()));
    };
    both.mass = massWithTensor(3, about(light, -center) + about(heavy, off - center));
    both.boxCenter = -center;
    setParts(both,
             {{.halfExtents = half, .center = -center}, {.halfExtents = other, .center = off - center}});
    both.initial.pose.position = at + axes * center;
    both.initial.velocity = Vec3::Zero();
    both.initial.angularMomentum = angularMomentum(both.mass, axes, spin);
    const World one = onRoughFloor({both}, 0.5, 0.3);
    const Recorded byJoint = runBy(welded, {.duration = 0.6});
    const Recorded asOne = runBy(one, {.duration = 0.6});
    const Pose first = byJoint.at(welded, 0, 0.6).pose;
    const Pose same = boxPose(one.bodies[0], asOne.at(one, 0, 0.6).pose);
    worst = std::max(
        worst, (first.position - same.position).norm() + (first.worldFromBody - same.worldFromBody).norm());
  }
  EXPECT_LT(worst, 1e-6);  // measured 4e-7, what a joint opens
}

}  // namespace
}  // namespace careen
