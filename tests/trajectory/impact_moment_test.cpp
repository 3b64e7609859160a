#include "trajectory/impact_moment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/error.h"
#include "physics/world/method.h"
#include "support/jointed.h"

namespace careen {
namespace {

World overFloor(double restitution, double friction) {
  World world;
  world.gravity = Vec3(0, 0, -10);
  world.walls = {wall("floor", Vec3::UnitZ(), 0, restitution)};
  world.walls[0].material.friction = friction;
  return world;
}

Body dieAt(const std::string& name, const Vec3& position, const Vec3& velocity, double friction) {
  Body body = box(name, Vec3::Constant(0.5), 1, position, velocity, Vec3::Zero(), 0);
  body.material.friction = friction;
  return body;
}

// A cube of 1 kg and 1 m, I = 1/6 kg m², on a corner whose arm is r = A (½, ½, ½) turned down, falls to the
// floor at v. With K = 1/m + |r × n|²/I the impulse is (1 + e) v/K, the loss ½ (1 − e²) v²/K; the point's
// tangential velocity after it is that of ω = I⁻¹ r × n j.
TEST(ImpactMoment, ofACornerByHand) {
  World world = overFloor(0.5, 0);
  world.bodies = {dieAt("die", Vec3(0, 0, 2), Vec3(0.3, 0, 0), 0)};
  const Mat3 turn =
      (Eigen::AngleAxisd(0.5, Vec3::UnitX()) * Eigen::AngleAxisd(0.4, Vec3::UnitY())).toRotationMatrix();
  world.bodies[0].initial.pose.worldFromBody = turn;
  Vec3 arm = Vec3::Zero();
  for (int k = 0; k < kCorners; ++k) {
    const Vec3 at = turn * corner(world.bodies[0], k);
    arm = at.z() < arm.z() ? at : arm;
  }
  const Trajectory run = record(world, {.duration = 0.6}, "");
  ASSERT_FALSE(run.impacts.empty());
  const ImpactMoment moment = impactMoment(run, 0);
  const double fall = 2 + arm.z();
  const double speed = std::sqrt(2 * 10 * fall);
  const Vec3 lever = arm.cross(Vec3::UnitZ());
  const double impulse = 1.5 * speed / (1 + 6 * lever.squaredNorm());
  EXPECT_NEAR(moment.time, speed / 10, 1e-12);
  EXPECT_EQ(moment.impacts, std::vector<std::size_t>{0});
  EXPECT_EQ(moment.law, ImpactLaw::kOneContact);
  ASSERT_EQ(moment.bodies.size(), 1U);
  const StruckBody& die = moment.bodies[0];
  EXPECT_LT((die.before.velocity - Vec3(0.3, 0, -speed)).norm(), 1e-12);
  EXPECT_LT((die.after.velocity - Vec3(0.3, 0, impulse - speed)).norm(), 1e-12);
  EXPECT_LT((angularVelocity(world.bodies[0].mass, die.after) - 6 * impulse * lever).norm(), 1e-12);
  EXPECT_NEAR(run.impacts[0].impulse, impulse, 1e-12);
  const PointVelocities at = pointVelocities(run.impacts[0], moment.bodies, world);
  EXPECT_LT((at.before - Vec3(0.3, 0, -speed)).norm(), 1e-12);
  const Vec3 after = Vec3(0.3, 0, impulse - speed) + 6 * impulse * lever.cross(arm);
  EXPECT_LT((at.after - after).norm(), 1e-12);
  EXPECT_NEAR(at.after.z(), 0.5 * speed, 1e-12);
  EXPECT_NEAR(
      kineticEnergy(world.bodies[0].mass, die.before) - kineticEnergy(world.bodies[0].mass, die.after),
      0.5 * 0.75 * speed * speed / (1 + 6 * lever.squaredNorm()), 1e-12);
  EXPECT_EQ(frictionOutcome(run.impacts[0], world), FrictionOutcome::kNone);
}

// A cube of 1 kg lands flat at (u, 0, −v): four corners, and −μ v along x as far as that does not stop it.
TEST(ImpactMoment, ofAFaceWithFriction) {
  for (const double friction : {0.125, 2.0}) {
    World world = overFloor(0, friction);
    world.bodies = {dieAt("die", Vec3(0, 0, 1.3), Vec3(2, 0, 0), friction),
                    dieAt("other", Vec3(9, 0, 1.3), Vec3(2, 0, 0), friction)};
    const Trajectory run = record(world, {.duration = 0.45}, "");
    ASSERT_EQ(run.impacts.size(), 8U);
    const ImpactMoment moment = impactMoment(run, 0);
    EXPECT_EQ(moment.impacts.size(), 4U);
    EXPECT_EQ(moment.atTheSameTime.size(), 4U);
    EXPECT_EQ(moment.law, ImpactLaw::kSeveralContacts);
    ASSERT_EQ(moment.bodies.size(), 1U);
    const BodyState& after = moment.bodies[0].after;
    if (friction < 1) {  // v = 4
      EXPECT_NEAR(after.velocity.x(), 2 - 0.125 * 4, 1e-9);
    } else {
      EXPECT_NEAR(pointVelocities(run.impacts[0], moment.bodies, world).after.x(), 0, 1e-9);
    }
    EXPECT_EQ(pairOf(run.impacts[0], world).friction, friction);
  }
}

// 1 kg at 3 m/s and 3 kg at −1 m/s, elastic: in their middle's frame both turn back, their relative velocity,
// too.
// A cube falls .45 m, 3 m/s, on a belt of 2 m/s, with friction .5: it slips at 2 m/s before, and at 2 − .5 ·
// 3 after.
TEST(ImpactMoment, onABeltIsRelativeToItsSurface) {
  World world = overFloor(0, 0.5);
  world.walls[0].material.surface.velocity = Vec3(2, 0, 0);
  world.bodies = {dieAt("die", Vec3(0, 0, 0.95), Vec3::Zero(), 0.5)};
  const Trajectory run = record(world, {.duration = 0.4}, "");
  ASSERT_FALSE(run.impacts.empty());
  const PointVelocities at = pointVelocities(run.impacts[0], impactMoment(run, 0).bodies, world);
  EXPECT_LT((at.before - Vec3(-2, 0, -3)).norm(), 1e-12);
  EXPECT_NEAR(at.after.x(), -0.5, 1e-12);
}

TEST(ImpactMoment, ofTwoBoxes) {
  World world;
  world.bodies = {box("light", Vec3::Constant(0.5), 1, Vec3(-2, 0, 0), Vec3(3, 0, 0)),
                  box("heavy", Vec3::Constant(0.5), 3, Vec3(2, 0, 0), Vec3(-1, 0, 0))};
  const Trajectory run = record(world, {.duration = 1.5}, "");
  ASSERT_FALSE(run.impacts.empty());
  const ImpactMoment moment = impactMoment(run, 0);
  EXPECT_EQ(moment.impacts.size(), run.impacts.size());
  ASSERT_EQ(moment.bodies.size(), 2U);
  EXPECT_LT((moment.bodies[0].after.velocity - Vec3(-3, 0, 0)).norm(), 1e-12);
  EXPECT_LT((moment.bodies[1].after.velocity - Vec3(1, 0, 0)).norm(), 1e-12);
  for (const Impact& impact : run.impacts) {
    const PointVelocities at = pointVelocities(impact, moment.bodies, world);
    EXPECT_NEAR(dot(at.before, impact.normal), -4, 1e-12);
    EXPECT_NEAR(dot(at.after, impact.normal), 4, 1e-12);
  }
}

// What hangs on a joint is struck with it; and a box in a crowd by the crowd's own way.
TEST(ImpactMoment, tellsJointsStepsAndCrowds) {
  World world = overFloor(0.5, 0.5);
  world.bodies = {dieAt("die", Vec3(0, 0, 1), Vec3::Zero(), 0.5),
                  dieAt("rider", Vec3(0, 0, 2.2), Vec3::Zero(), 0.5)};
  world.bodies.push_back(dieAt("last", Vec3(0, 0, 3.4), Vec3::Zero(), 0.5));
  test::join(world, Joint::Kind::kBall, 0, 1, Vec3(0, 0, 1.6));
  test::join(world, Joint::Kind::kBall, 1, 2, Vec3(0, 0, 2.8));
  const ImpactMoment joined = impactMoment(record(world, {.duration = 0.5}, ""), 0);
  EXPECT_EQ(joined.law, ImpactLaw::kInSteps);
  EXPECT_EQ(joined.joints, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(joined.bodies.size(), 3U);

  world.joints.clear();
  world.apart.clear();
  RunSettings settings{.duration = 1};
  settings.crowds = {.when = CrowdSettings::When::kAbove, .above = 0};
  const Trajectory crowd = record(world, settings, "");
  ASSERT_FALSE(crowd.impacts.empty());
  EXPECT_EQ(impactMoment(crowd, static_cast<int>(crowd.impacts.size()) - 1).law, ImpactLaw::kInCrowd);

  settings = {.method = Method::kListing1, .duration = 0.5, .dt = 0.001};
  world.bodies.resize(1);
  EXPECT_EQ(impactMoment(record(world, settings, ""), 0).law, ImpactLaw::kLoop1997);
}

TEST(ImpactMoment, tellsStickingFromSliding) {
  World world = overFloor(0, 0.5);
  world.bodies = {dieAt("die", Vec3::Zero(), Vec3::Zero(), 0.5)};
  const auto outcomeOf = [&](double tangential) {
    Impact impact;
    impact.impulse = 2;
    impact.tangential = tangential;
    return frictionOutcome(impact, world);
  };
  EXPECT_EQ(outcomeOf(1), FrictionOutcome::kSlides);
  EXPECT_EQ(outcomeOf(0.99), FrictionOutcome::kSticks);
  EXPECT_EQ(outcomeOf(0), FrictionOutcome::kIdle);
  world.walls[0].material.friction = 0;
  EXPECT_EQ(outcomeOf(0), FrictionOutcome::kNone);
}

TEST(ImpactMoment, refusesAnIndexThatIsNotThere) {
  World world = overFloor(0.5, 0);
  world.bodies = {dieAt("die", Vec3(0, 0, 1), Vec3::Zero(), 0)};
  const Trajectory run = record(world, {.duration = 0.4}, "");
  ASSERT_EQ(run.impacts.size(), 4U);
  EXPECT_EQ(impactMoment(run, 3).impacts.size(), 4U);
  for (const int index : {-1, 4}) {
    try {
      impactMoment(run, index);
      ADD_FAILURE();
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()),
                "found impact " + std::to_string(index) + ", expected 0 to 3: the run has 4 impacts");
    }
  }
}

}  // namespace
}  // namespace careen
