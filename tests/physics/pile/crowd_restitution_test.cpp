#include "physics/pile/crowd_restitution.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "support/crates.h"
#include "support/crowd_stages.h"

namespace careen {
namespace {

using namespace test;

constexpr double kHalf = 0.25;

// Cubes of 1 kg in a row along x that touch; the first one moves.
World rowOfCubes(std::size_t count, double speed) {
  World world;
  world.gravity = Vec3::Zero();
  for (std::size_t k = 0; k < count; ++k) {
    const std::string name(1, static_cast<char>('a' + k));
    world.bodies.push_back(
        crate(name, Vec3::Constant(kHalf), Vec3(2 * kHalf * static_cast<double>(k), 0, 0), {}));
    world.bodies.back().mass = solidBox(Vec3::Constant(kHalf), 1);
  }
  world.bodies[0].initial.velocity = Vec3(speed, 0, 0);
  return world;
}

// The contacts of a world in which what approaches strikes.
struct Struck {
  Struck(const World& world, std::vector<double> restitutions, double slow = 0)
      : stages(world), restitution(stages.members, stages.contacts) {
    stages.members.begin();
    stages.meet(kCrowdStep);
    stages.impulses.find();
    restitution.begin();
    std::size_t n = 0;
    for (const int slot : stages.contacts.near()) {
      stages.contacts[slot].material.restitution = restitutions[n++ % restitutions.size()];
    }
    for (const int slot : stages.contacts.near()) {
      const PileManifold& manifold = stages.contacts[slot];
      for (int k = 0; k < manifold.count; ++k) {
        const PilePoint& point = manifold.points[at(k)];
        if (point.row >= 0 && point.speed < 0) {
          restitution.strike(slot, k, -point.speed);
        }
      }
    }
    restitution.resolve(slow);
  }
  // [N s] of the law, on the points between two places.
  double impulse(int a, int b) const {
    double sum = 0;
    for (const ReachedPoint& point : restitution.points()) {
      const PileManifold& manifold = stages.contacts[point.slot];
      if ((manifold.a == a && manifold.b == b) || (manifold.a == b && manifold.b == a)) {
        sum += point.whole;
      }
    }
    return sum;
  }

  CrowdStages stages;
  CrowdRestitution restitution;
};

// Elastic: all the impulse goes on to the last. Plastic: all go on together. Between: parts of both. Measured
// to 4e-6 N s where plastic impulses take part, which are found to 1/1024 of the slowest impact; else exact.
TEST(CrowdRestitution, rowPassesImpulsesOnAsTheLawSays) {
  constexpr int kCount = 5;
  const double speed = 2;
  for (const double e : {0.0, 0.25, 1.0}) {
    const Struck struck(rowOfCubes(kCount, speed), {e});
    for (int k = 0; k + 1 < kCount; ++k) {
      const double plastic = speed * (kCount - 1 - k) / kCount;
      EXPECT_NEAR(struck.impulse(k, k + 1), e * speed + (1 - e) * plastic, 1e-5 * speed) << e << ' ' << k;
    }
  }
}

// A strikes B, which touches C. Elastic reflections of the first contact leave B with the speed, the second
// is plastic: 0, 1/2, 1/2. All plastic: 1/3 each.
TEST(CrowdRestitution, contactsOfOtherRestitutionArePlasticBelowTheirLevel) {
  const Struck elastic(rowOfCubes(3, 1), {1, 0});
  EXPECT_NEAR(elastic.impulse(0, 1), 1, 1e-5);
  EXPECT_NEAR(elastic.impulse(1, 2), 0.5, 1e-5);
  const Struck half(rowOfCubes(3, 1), {0.5, 0});
  EXPECT_NEAR(half.impulse(0, 1), 0.5 * 1 + 0.5 * 2 / 3, 1e-5);
  EXPECT_NEAR(half.impulse(1, 2), 0.5 * 0.5 + 0.5 / 3, 1e-5);
}

// Onto a column that stands on the floor: reflections go down and up again, so that every contact passes the
// impulse 2 m v, and only the striker moves.
TEST(CrowdRestitution, columnThrowsTheStrikerBack) {
  World world = floorWorld({});
  world.gravity = Vec3::Zero();
  for (int k = 0; k < 4; ++k) {
    world.bodies.push_back(crate(std::string(1, static_cast<char>('a' + k)), Vec3::Constant(kHalf),
                                 Vec3(0, 0, kHalf + 2 * kHalf * k), {}));
    world.bodies.back().mass = solidBox(Vec3::Constant(kHalf), 1);
  }
  world.bodies[3].initial.velocity = Vec3(0, 0, -3);
  const Struck struck(world, {1});
  for (int k = 0; k < 4; ++k) {  // the floor has the first place
    EXPECT_NEAR(struck.impulse(k, k + 1), 6, 1e-9) << k;
  }
}

// Far along a long row: only what impulses reach is looked at.
TEST(CrowdRestitution, slowApproachReachesNobody) {
  const Struck struck(rowOfCubes(9, 1), {1}, 1.5);
  EXPECT_EQ(struck.impulse(0, 1), 0);
  EXPECT_LE(struck.restitution.bodies().size(), 3U);
}

}  // namespace
}  // namespace careen
