#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "physics/exact/exact_world.h"
#include "support/exact_runs.h"
#include "support/impact_scene.h"

// Lasting contact with friction has the same bits in mirrors, under other names, and with powers of two as
// units. The motions are chaotic: what differs in the last bit at first soon differs in the first.

namespace careen {
namespace {

using test::Random;

struct Scene {
  World world;
  double duration = 0;
  double tolerance = 1e-6;
};

Wall roughFloor() {
  Wall floor = wall("floor", Vec3::UnitZ(), 0);
  floor.material = {.restitution = 0.2, .friction = 0.5};
  return floor;
}

/// Boxes that fall onto each other: impacts, slip, rolling, rest.
Scene pour(std::uint64_t seed) {
  Random random(seed);
  Scene scene{.world = {}, .duration = 1.5};
  scene.world.gravity = Vec3(0, 0, -9.81);
  scene.world.walls.push_back(roughFloor());
  double height = 0.1;
  for (int k = 0; k < 4; ++k) {
    const Vec3 half(random.between(0.1, 0.3), random.between(0.1, 0.3), random.between(0.1, 0.3));
    height += half.norm();
    Body body = box("box-" + std::to_string(k), half, random.between(0.5, 5),
                    Vec3(random.between(-0.2, 0.2), random.between(-0.2, 0.2), height), random.inCube(1));
    body.initial.pose.worldFromBody = random.rotation();
    body.initial.angularMomentum =
        angularMomentum(body.mass, body.initial.pose.worldFromBody, random.inCube(4));
    body.material = {.restitution = random.between(0, 0.5), .friction = random.between(0.2, 0.8)};
    scene.world.bodies.push_back(body);
    height += half.norm();
  }
  return scene;
}

/// Equal dominoes, some of them turned a little: boxes that only their places tell apart.
Scene dominoes(std::uint64_t seed) {
  Random random(seed);
  Scene scene{.world = {}, .duration = 1};
  scene.world.gravity = Vec3(0, 0, -9.81);
  scene.world.walls.push_back(roughFloor());
  const Vec3 half(0.03, 0.12, 0.25);
  for (int k = 0; k < 5; ++k) {
    Body body = box("domino-" + std::to_string(k), half, 1, Vec3(0.22 * k, 0, half.z()));
    body.initial.pose.worldFromBody = test::aboutZ(k % 2 == 0 ? 0 : random.between(-0.1, 0.1));
    body.material = {.restitution = 0, .friction = 0.4};
    scene.world.bodies.push_back(body);
  }
  Body& first = scene.world.bodies.front();
  first.initial.angularMomentum =
      angularMomentum(first.mass, first.initial.pose.worldFromBody, Vec3(0, 2, 0));
  first.initial.velocity = Vec3(0.5, 0, 0);
  return scene;
}

Recorded run(const Scene& scene) {
  Recorded run;
  run.motions.resize(scene.world.bodies.size());
  Notes notes(run);
  run.figures =
      ExactWorld(scene.world, {.duration = scene.duration, .tolerance = scene.tolerance}, notes).run({});
  return run;
}

Scene mirrored(Scene scene, int axis) {
  Vec3 mirror = Vec3::Ones();
  mirror[axis] = -1;
  World& world = scene.world;
  world.gravity = mirror.cwiseProduct(world.gravity);
  for (Wall& each : world.walls) {
    each.normal = mirror.cwiseProduct(each.normal);
  }
  for (Body& body : world.bodies) {
    BodyState& start = body.initial;
    start.pose.position = mirror.cwiseProduct(start.pose.position);
    start.pose.worldFromBody = mirror.asDiagonal() * start.pose.worldFromBody * mirror.asDiagonal();
    start.velocity = mirror.cwiseProduct(start.velocity);
    start.angularMomentum = -mirror.cwiseProduct(start.angularMomentum);
  }
  return scene;
}

struct Units {
  double length = 1;
  double time = 1;
  double mass = 1;
};

Scene inUnits(Scene scene, const Units& units) {
  World& world = scene.world;
  world.gravity *= units.length / (units.time * units.time);
  for (Body& body : world.bodies) {
    body.halfExtents *= units.length;
    body.mass = solidBox(body.halfExtents, body.mass.mass * units.mass);
    body.initial.pose.position *= units.length;
    body.initial.velocity *= units.length / units.time;
    body.initial.angularMomentum *= units.mass * units.length * units.length / units.time;
  }
  scene.duration *= units.time;
  scene.tolerance *= units.length;
  return scene;
}

constexpr int kMoments = 64;

/// Compares two runs at many moments; `image` maps a position of the first to one of the second.
template <class Image>
void expectSame(const Scene& scene, const Recorded& first, const Scene& other, const Recorded& second,
                const Image& image) {
  for (int moment = 0; moment <= kMoments; ++moment) {
    for (std::size_t body = 0; body < scene.world.bodies.size(); ++body) {
      const BodyState one = first.at(scene.world, body, scene.duration * moment / kMoments);
      const BodyState two = second.at(other.world, body, other.duration * moment / kMoments);
      ASSERT_EQ(Vec3(image(one.pose.position)), two.pose.position) << "box " << body << ", moment " << moment;
    }
  }
}

std::vector<Scene> scenes() {
  std::vector<Scene> scenes;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    scenes.push_back(pour(seed));
  }
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    scenes.push_back(dominoes(seed));
  }
  return scenes;
}

class ExactWorldInvariance : public ::testing::TestWithParam<std::size_t> {
 protected:
  Scene scene_ = scenes()[GetParam()];
  Recorded run_ = run(scene_);
};

TEST_P(ExactWorldInvariance, hasTheSameBitsInMirrors) {
  ASSERT_GT(run_.impacts.size(), 10U);
  for (int axis = 0; axis < 3; ++axis) {
    SCOPED_TRACE(axis);
    const Scene image = mirrored(scene_, axis);
    Vec3 mirror = Vec3::Ones();
    mirror[axis] = -1;
    expectSame(scene_, run_, image, run(image), [&](const Vec3& at) { return mirror.cwiseProduct(at); });
  }
}

TEST_P(ExactWorldInvariance, hasTheSameBitsInUnitsThatArePowersOfTwo) {
  for (const Units units : {Units{.length = 2}, Units{.length = 0.25}, Units{.time = 4}, Units{.mass = 8},
                            Units{.length = 8, .time = 0.5, .mass = 2}}) {
    SCOPED_TRACE("length " + std::to_string(units.length) + ", time " + std::to_string(units.time) +
                 ", mass " + std::to_string(units.mass));
    const Scene other = inUnits(scene_, units);
    expectSame(scene_, run_, other, run(other), [&](const Vec3& at) { return units.length * at; });
  }
}

TEST_P(ExactWorldInvariance, hasTheSameBitsUnderOtherNames) {
  Scene other = scene_;
  for (std::size_t k = 0; k < other.world.bodies.size(); ++k) {
    other.world.bodies[k].name = "n" + std::to_string(9 - k);
  }
  expectSame(scene_, run_, other, run(other), [](const Vec3& at) { return at; });
}

INSTANTIATE_TEST_SUITE_P(Scenes, ExactWorldInvariance, ::testing::Range(std::size_t{0}, std::size_t{8}));

// A quarter turn about the vertical is none of powers of two: its rounding must stay rounding. Where a face
// lands without restitution, corners that neither close nor open were closed or open as it rounded, and
// friction has an answer for each: 2e-4 m. Measured 6e-12 m.
TEST(ExactWorldInvariance, aQuarterTurnChangesRoundingOnly) {
  const Mat3 turn = (Mat3() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished();
  const Mat3 tilt = Quat(0.9, 0.1, -0.3, 0.2).normalized().toRotationMatrix();
  double worst = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    Scene scene{.world = {}, .duration = 1};
    scene.world.gravity = Vec3(0, 0, -9.81);
    scene.world.walls.push_back(roughFloor());
    scene.world.walls[0].material.restitution = 0;
    const Vec3 half(random.between(0.06, 0.2), random.between(0.06, 0.2), random.between(0.06, 0.2));
    Body body = box("box", half, 1, Vec3(0.1, 0.2, 0.4), random.inCube(1), Vec3::Zero(), 0);
    body.material.friction = 0.5;
    body.initial.pose.worldFromBody = random.rotation() * tilt;
    body.initial.angularMomentum =
        angularMomentum(body.mass, body.initial.pose.worldFromBody, random.inCube(5));
    scene.world.bodies = {body};
    Scene turned = scene;
    BodyState& start = turned.world.bodies[0].initial;
    start = {.pose = {turn * start.pose.position, turn * start.pose.worldFromBody},
             .velocity = turn * start.velocity,
             .angularMomentum = turn * start.angularMomentum};
    const BodyState end = run(scene).last(scene.world, 0, 1);
    const BodyState other = run(turned).last(turned.world, 0, 1);
    worst = std::max(worst, (turn * end.pose.position - other.pose.position).norm());
  }
  EXPECT_LT(worst, 1e-10);
}

}  // namespace
}  // namespace careen
