// Boxes with a centre of mass and axes of their own, at random: the audit, which shares no code with the
// methods, finds nothing.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "audit/audit.h"
#include "physics/world/given_inertia.h"
#include "support/exact_runs.h"

namespace careen {
namespace {

World loadedBoxes(unsigned seed, int count, double friction, double restitution) {
  std::mt19937_64 engine(seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(engine() >> 11U) * 0x1p-53);
  };
  const auto inCube = [&](double size) {
    return Vec3(between(-size, size), between(-size, size), between(-size, size));
  };
  World world;
  world.gravity = Vec3(0, 0, -9.81);
  double height = 0.2;
  for (int k = 0; k < count; ++k) {
    const Vec3 half(between(0.1, 0.4), between(0.1, 0.4), between(0.1, 0.4));
    const Vec3 inside = inCube(0.8).cwiseProduct(half);
    height += half.norm();
    Body body = box("box-" + std::to_string(k), half, between(0.5, 5), Vec3::Zero());
    const Vec3 axis = inCube(1).normalized();
    const Mat3 axes = Eigen::AngleAxisd(between(0, 3), axis).toRotationMatrix();
    Mat3 tensor = axes * body.mass.inertiaBody.asDiagonal() * axes.transpose();
    tensor = (0.5 * (tensor + tensor.transpose())).eval();
    body.mass = massWithTensor(body.mass.mass, tensor);
    body.boxCenter = -inside;
    body.initial.pose.worldFromBody =
        Eigen::AngleAxisd(between(0, 3), inCube(1).normalized()).toRotationMatrix();
    body.initial.pose = bodyPose(
        body, {Vec3(between(-0.3, 0.3), between(-0.3, 0.3), height), body.initial.pose.worldFromBody});
    body.initial.velocity = inCube(1);
    body.initial.angularMomentum = angularMomentum(body.mass, body.initial.pose.worldFromBody, inCube(4));
    body.material = {.restitution = restitution, .friction = friction};
    world.bodies.push_back(body);
    height += half.norm();
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {1.0, -1.0}) {
      const double offset = axis < 2 ? -2 : side > 0 ? 0 : -height - 1;
      world.walls.push_back(wall({side > 0 ? '-' : '+', static_cast<char>('x' + axis)},
                                 side * Vec3::Unit(axis), offset, restitution));
      world.walls.back().material.friction = friction;
    }
  }
  return world;
}

std::string breachesOf(const World& world, const RunSettings& settings) {
  const Trajectory run = record(world, settings, "");
  const Audit found = audit(run, AuditDepth::kUsual);
  std::string text;
  for (const AuditBreach& breach : found.breaches) {
    text += describe(breach, run) + "\n";
  }
  return text;
}

TEST(AuditOfLoadedBoxes, oneThatBouncesKeepsAllPromises) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    const World world = loadedBoxes(seed, 1, seed % 2 == 0 ? 0.4 : 0, seed % 3 == 0 ? 1 : 0.5);
    EXPECT_EQ(breachesOf(world, {.duration = 1.5}), "") << seed;
  }
}

TEST(AuditOfLoadedBoxes, someThatMeetKeepAllPromises) {
  for (unsigned seed = 100; seed < 140; ++seed) {
    const World world = loadedBoxes(seed, 3, 0.4, seed % 2 == 0 ? 0 : 0.3);
    EXPECT_EQ(breachesOf(world, {.duration = 1.5}), "") << seed;
  }
}

TEST(AuditOfLoadedBoxes, crowdsKeepTheirs) {
  for (unsigned seed = 200; seed < 220; ++seed) {
    const World world = loadedBoxes(seed, 8, 0.4, 0.2);
    EXPECT_EQ(
        breachesOf(world, {.duration = 1.5, .crowds = {.when = CrowdSettings::When::kAbove, .above = 0}}), "")
        << seed;
  }
}

}  // namespace
}  // namespace careen
