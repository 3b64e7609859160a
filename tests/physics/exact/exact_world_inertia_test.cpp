// Boxes with an inertia of their own: a block that falls from edge onto face, and an impact off the centre,
// against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "physics/world/given_inertia.h"
#include "support/article_equations.h"
#include "support/exact_runs.h"

namespace careen {
namespace {

constexpr double kGravity = 9.81;

// Tilted about its edge along y by `tilt`, at rest, on a rough floor: until it lies flat, the edge stays
// where it is.
World tilted(const Vec3& half, double tilt, double factor) {
  World world;
  world.gravity = Vec3(0, 0, -kGravity);
  world.walls = {wall("floor", Vec3::UnitZ(), 0, 0)};
  world.walls[0].material.friction = 9;
  Body block = box("block", half, 3, Vec3::Zero());
  block.material = {.restitution = 0, .friction = 9};
  block.mass = massWithInertia(3, factor * block.mass.inertiaBody);
  const Mat3 turned = axisAngle(Vec3::UnitY(), tilt);  // the edge at +x is the lowest
  block.initial.pose.worldFromBody = turned;
  block.initial.pose.position = turned * Vec3(-half.x(), 0, half.z());
  world.bodies = {block};
  return world;
}

// ½ I_edge ω² = m g (height now − height flat): the speed with which it lies down, and with it its inertia.
TEST(ExactWorldInertia, aBlockTipsAsItsInertiaTells) {
  const Vec3 half(0.2, 0.3, 0.1);
  const double tilt = 0.3;
  for (const double factor : {0.4, 1.0, 1.9}) {
    const World world = tilted(half, tilt, factor);
    const Body& block = world.bodies[0];
    const Recorded run = runFor(world, 0.6);
    ASSERT_FALSE(run.impacts.empty()) << factor;
    const double aboutEdge = block.mass.inertiaBody.y() + 3 * (half.x() * half.x() + half.z() * half.z());
    const double fall = block.initial.pose.position.z() - half.z();
    const double spin = std::sqrt(2 * 3 * kGravity * fall / aboutEdge);
    // The far edge comes down with 2 a ω.
    double approach = 0;
    for (const Impact& impact : run.impacts) {
      approach = std::max(approach, impact.approach);
    }
    EXPECT_NEAR(approach, 2 * half.x() * spin, 1e-4 * spin) << factor;
  }
}

// A corner struck without friction: the impulse is (1 + e) v / (1/m + (r × n)ᵀ I⁻¹ (r × n)).
TEST(ExactWorldInertia, anImpactOffTheCentreTurnsAsItsInertiaTells) {
  for (const double factor : {0.3, 1.0, 1.7}) {
    World world;
    world.walls = {wall("floor", Vec3::UnitZ(), 0, 0.5)};
    Body die = box("die", Vec3(0.1, 0.1, 0.1), 2, Vec3(0, 0, 0.4), Vec3(0, 0, -1));
    die.material.restitution = 0.5;
    die.mass = massWithInertia(2, factor * Vec3(0.01, 0.02, 0.025));
    die.initial.pose.worldFromBody = axisAngle(Vec3(1, 2, 0.5).normalized(), 0.7);
    world.bodies = {die};
    const Recorded run = runFor(world, 0.5);
    ASSERT_GE(run.impacts.size(), 1U);
    const Impact& impact = run.impacts[0];
    const Vec3 arm = die.initial.pose.worldFromBody.transpose() *
                     (impact.point - (die.initial.pose.position - impact.time * Vec3::UnitZ()));
    const Vec3 normal = die.initial.pose.worldFromBody.transpose() * Vec3::UnitZ();
    const Vec3 lever = arm.cross(normal);
    const double effective = 1 / 2.0 + lever.dot(die.mass.inverseInertiaBody.cwiseProduct(lever));
    EXPECT_NEAR(impact.impulse, 1.5 / effective, 1e-13) << factor;
  }
}

// Next to no moment about one axis: a corner strikes with 1e-10 of the mass, the next with all that is left.
TEST(ExactWorldInertia, boxesOfOneVanishingMomentLand) {
  for (const double moment : {1e-6, 1e-9, 1e-12}) {
    World world;
    world.gravity = Vec3(0, 0, -kGravity);
    world.walls = {wall("floor", Vec3::UnitZ(), 0, 0.4)};
    world.walls[0].material.friction = 0.4;
    Body thin = box("thin", Vec3(0.1, 0.1, 0.1), 1, Vec3(0, 0, 0.5), Vec3(0.5, -1.79, -0.78));
    thin.material = {.restitution = 0.4, .friction = 0.4};
    thin.mass = massWithInertia(1, Vec3(1, moment, 1));
    thin.initial.angularMomentum = Vec3(0.22, 4.4 * moment, 0.013);
    world.bodies = {thin};
    const Recorded run = runFor(world, 2);
    EXPECT_GT(run.impacts.size(), 10U) << moment;
    const Vec3 position = run.last(world, 0, 2).pose.position;
    EXPECT_GT(position.z(), 0.1 - 1e-5) << moment;
    EXPECT_LT(position.z(), 0.3) << moment;
  }
}

}  // namespace
}  // namespace careen
