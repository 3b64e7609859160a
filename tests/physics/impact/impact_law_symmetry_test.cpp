#include "physics/impact/impact_law.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "support/impact_scene.h"

namespace careen {
namespace {

using test::ImpactScene;
using test::Random;
using test::randomImpact;
using test::sameBits;

TEST(ImpactLaw, orderOfTheContactsChangesNoBit) {
  Random random(6);
  for (int k = 0; k < 500; ++k) {
    ImpactScene scene = randomImpact(random, 8, k % 2 == 0);
    ImpactScene other = scene;
    std::vector<std::size_t> order(scene.contacts.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = order.size(); i > 1; --i) {
      std::swap(order[i - 1], order[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
    }
    for (std::size_t i = 0; i < order.size(); ++i) {
      other.contacts[i] = scene.contacts[order[i]];
    }
    scene.resolve();
    other.resolve();
    for (std::size_t b = 0; b < scene.states.size(); ++b) {
      EXPECT_TRUE(sameBits(scene.states[b], other.states[b]))
          << k << " " << (scene.states[b].velocity - other.states[b].velocity).norm();
    }
    for (std::size_t i = 0; i < order.size(); ++i) {
      ASSERT_EQ(other.shares[i].impulse, scene.shares[order[i]].impulse) << k;
      ASSERT_EQ(other.shares[i].tangential, scene.shares[order[i]].tangential) << k;
    }
  }
}

// Seen from a wall whose surface moves along itself, an impact is as with one that is still: 4e-10 off at
// most.
TEST(ImpactLaw, isTheSameInTheFrameThatMovesWithASurface) {
  Random random(8);
  for (int k = 0; k < 500; ++k) {
    ImpactScene still = randomImpact(random, k % 3 == 0 ? 1 : 6, true);
    const Vec3 normal = random.direction();
    Vec3 velocity = random.inCube(2);
    velocity -= normal.dot(velocity) * normal;
    for (ImpactContact& contact : still.contacts) {
      contact.normal = contact.b == still.wall() ? normal : contact.normal;
    }
    ImpactScene moving = still;
    for (ImpactContact& contact : moving.contacts) {
      contact.material.surface.velocity = contact.b == still.wall() ? velocity : Vec3(Vec3::Zero());
    }
    for (BodyState& state : moving.states) {
      state.velocity += velocity;
    }
    still.resolve();
    moving.resolve();
    for (std::size_t b = 0; b < still.states.size(); ++b) {
      EXPECT_LT((moving.states[b].velocity - velocity - still.states[b].velocity).norm(), 2e-9) << k;
      EXPECT_LT((moving.states[b].angularMomentum - still.states[b].angularMomentum).norm(), 2e-9) << k;
    }
  }
}

TEST(ImpactLaw, mirroredImpactHasTheMirroredBits) {
  Random random(7);
  for (int k = 0; k < 500; ++k) {
    ImpactScene scene = randomImpact(random, 8, k % 2 == 0);
    ImpactScene other = scene;
    Vec3 mirror = Vec3::Ones();
    mirror[k % 3] = -1;
    const Mat3 flip = mirror.asDiagonal();
    for (BodyState& state : other.states) {
      state.velocity = flip * state.velocity;
      state.angularMomentum = -(flip * state.angularMomentum);
      state.pose.worldFromBody = flip * state.pose.worldFromBody * flip;
    }
    for (ImpactContact& c : other.contacts) {
      c.armA = flip * c.armA;
      c.armB = flip * c.armB;
      c.normal = flip * c.normal;
    }
    scene.resolve();
    other.resolve();
    for (std::size_t b = 0; b < scene.states.size(); ++b) {
      ASSERT_EQ(other.states[b].velocity, Vec3(flip * scene.states[b].velocity)) << k;
      ASSERT_EQ(other.states[b].angularMomentum, Vec3(-(flip * scene.states[b].angularMomentum))) << k;
    }
  }
}

TEST(ImpactLaw, powersOfTwoScaleEveryBit) {
  Random random(8);
  constexpr double kLength = 4;
  constexpr double kTime = 2;
  for (int k = 0; k < 500; ++k) {
    const double mass = k % 2 == 0 ? 8 : 64;  // mass kept by itself, or density kept
    ImpactScene scene = randomImpact(random, 8, k % 4 < 2);
    ImpactScene other = scene;
    for (std::size_t b = 0; b < scene.states.size(); ++b) {
      other.masses[b].mass *= mass;
      other.masses[b].inverseMass /= mass;
      other.masses[b].inertiaBody *= mass * kLength * kLength;
      other.masses[b].inverseInertiaBody /= mass * kLength * kLength;
      other.states[b].velocity *= kLength / kTime;
      other.states[b].angularMomentum *= mass * kLength * kLength / kTime;
    }
    for (ImpactContact& c : other.contacts) {
      c.armA *= kLength;
      c.armB *= kLength;
    }
    scene.resolve();
    other.resolve();
    for (std::size_t b = 0; b < scene.states.size(); ++b) {
      ASSERT_EQ(other.states[b].velocity, Vec3(kLength / kTime * scene.states[b].velocity)) << k;
      ASSERT_EQ(other.states[b].angularMomentum,
                Vec3(mass * kLength * kLength / kTime * scene.states[b].angularMomentum))
          << k;
    }
  }
}

}  // namespace
}  // namespace careen
