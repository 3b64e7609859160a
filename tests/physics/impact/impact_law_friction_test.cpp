#include "physics/impact/impact_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "support/impact_scene.h"

namespace careen {
namespace {

using test::flatCube;
using test::ImpactScene;
using test::Quad;
using test::Quad3;
using test::Random;
using test::randomImpact;
using test::relativeChange;

TEST(ImpactLaw, millionRandomImpactsWithFrictionGainNoEnergy) {
  Random random(11);
  double gained = -1;
  double cone = 0;
  for (int hits = 0; hits < 1'000'000;) {
    ImpactScene scene = randomImpact(random, 1, true);
    if (hits % 4 == 0) {  // where next to nothing is lost, rounding could show as a gain
      scene.contacts[0].material = {.restitution = 1,
                                    .friction = 0x1p-45 * scene.contacts[0].material.friction};
    }
    const auto energy = [&]() {  // plain doubles: four times faster, and sharp enough for the bound
      double twice = 0;
      for (std::size_t b = 0; b < scene.states.size(); ++b) {
        const BodyState& s = scene.states[b];
        twice += scene.masses[b].mass * s.velocity.squaredNorm() +
                 s.angularMomentum.dot(angularVelocity(scene.masses[b], s));
      }
      return twice / 2;
    };
    const double before = energy();
    scene.resolve();
    const ImpactShare& share = scene.shares[0];
    if (share.approach <= 0) {
      continue;
    }
    ++hits;
    gained = std::max(gained, (energy() - before) / before);
    cone = std::max(cone, share.tangential - scene.contacts[0].material.friction * share.impulse);
  }
  EXPECT_LT(gained, 1e-14);  // measured 4.5e-16
  EXPECT_LT(cone, 1e-13);
  RecordProperty("gained", std::to_string(gained * 1e16) + "e-16");
}

TEST(ImpactLaw, manyContactsWithFrictionGainNoEnergy) {
  Random random(12);
  double gained = -1;
  double deepest = 0;
  double cone = 0;
  for (int k = 0; k < 3000; ++k) {
    ImpactScene scene = randomImpact(random, 8, true);
    const ImpactScene start = scene;
    const Quad before = scene.energy();
    scene.resolve();
    gained = std::max(gained, relativeChange(scene.energy(), before));
    double speed = 0;
    double largest = 0;
    for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
      speed = std::max(speed, static_cast<double>(Quad(start.relativeVelocity(scene.contacts[c]).norm())));
      largest = std::max(largest, scene.shares[c].impulse);
    }
    for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
      deepest = std::max(deepest, -scene.partingSpeed(scene.contacts[c]) / speed);
      cone = std::max(
          cone, (scene.shares[c].tangential - scene.contacts[c].material.friction * scene.shares[c].impulse) /
                    (largest + 1e-300));
    }
  }
  EXPECT_LT(gained, 1e-13);
  EXPECT_LT(deepest, 1e-12);  // measured 1.3e-15
  EXPECT_LT(cone, 1e-12);     // measured 2.1e-14
  RecordProperty("gained", std::to_string(gained * 1e16) + "e-16");
  RecordProperty("approach", std::to_string(deepest * 1e16) + "e-16");
  RecordProperty("cone", std::to_string(cone * 1e16) + "e-16");
}

/// In quadruple precision: what Coulomb's law asks of one contact after the impact, as the header states it.
TEST(ImpactLaw, frictionOpposesTheSlipLeftAfterCompression) {
  Random random(13);
  double normal = 0;
  double direction = 0;
  double stick = 0;
  int slips = 0;
  int sticks = 0;
  for (int k = 0; k < 20000; ++k) {
    ImpactScene scene = randomImpact(random, 1, true);
    scene.contacts[0].material.friction = random.between(0.05, 0.6);
    const ImpactContact c = scene.contacts[0];
    const double before = scene.partingSpeed(c);
    if (before >= -0.1) {
      continue;
    }
    ImpactScene plastic =
        scene;  // frictionless, e = 0 and as it is: their difference is what restitution adds
    plastic.contacts[0].material = {.restitution = 0, .friction = 0};
    ImpactScene elastic = scene;
    elastic.contacts[0].material.friction = 0;
    plastic.resolve();
    elastic.resolve();
    scene.resolve();
    const Quad3 n = c.normal.cast<Quad>();
    const Quad3 left = scene.relativeVelocity(c) - elastic.relativeVelocity(c) + plastic.relativeVelocity(c);
    const Quad3 slip = left - n * n.dot(left);
    normal = std::max(normal, std::fabs(scene.partingSpeed(c) + c.material.restitution * before));
    const ImpactShare& share = scene.shares[0];
    const double size = static_cast<double>(Quad(slip.norm()));
    if (share.tangential < (1 - 1e-12) * c.material.friction * share.impulse) {
      ++sticks;
      stick = std::max(stick, size);
    } else if (size > 1e-3) {
      ++slips;
      // The tangential impulse is what changed the momentum of a, less its normal part.
      const auto a = static_cast<std::size_t>(c.a);
      Vec3 j = scene.masses[a].mass * (scene.states[a].velocity - elastic.states[a].velocity);
      j -= c.normal * c.normal.dot(j);
      const Vec3 s = slip.cast<double>();
      direction =
          std::max(direction, (j / j.norm() + s / s.norm()).norm() * std::min(1.0, size) * share.tangential /
                                  (scene.masses[a].mass * scene.states[a].velocity.norm()));
    }
  }
  EXPECT_GT(slips, 1000);
  EXPECT_GT(sticks, 1000);
  EXPECT_LT(normal, 1e-13);     // measured 4e-15
  EXPECT_LT(stick, 1e-13);      // measured 5e-15
  EXPECT_LT(direction, 1e-13);  // measured 2.3e-14
  RecordProperty("normal", std::to_string(normal * 1e16) + "e-16");
  RecordProperty("stick", std::to_string(stick * 1e16) + "e-16");
  RecordProperty("direction", std::to_string(direction * 1e16) + "e-16");
}

TEST(ImpactLaw, boxLandingFlatSlidesOnSlowerByMuTimesTheNormalImpulse) {
  // Flat on four corners: v_t falls by μ (1+e) v_n whatever the azimuth, as long as the box does not trip,
  // that is while μ h < a with half height h and half width a.
  double worst = 0;
  for (const double e : {0.0, 0.5, 1.0}) {
    for (int k = 0; k < 36; ++k) {
      const double azimuth = 0.1745 * k;
      const Vec3 along(std::cos(azimuth), std::sin(azimuth), 0);
      ImpactScene scene = flatCube(0.2, e, 0.25, 5 * along + Vec3(0, 0, -2), Vec3(0.5, 0.5, 0.2));
      scene.resolve();
      const Vec3 expected = (5 - 0.25 * (1 + e) * 2) * along + Vec3(0, 0, e * 2);
      worst = std::max(worst, (scene.states[0].velocity - expected).norm());
      worst = std::max(worst, scene.states[0].angularMomentum.norm());
    }
  }
  EXPECT_LT(worst, 1e-14);  // measured 1e-15
}

TEST(ImpactLaw, boxLandingFlatSticksWhereFrictionSuffices) {
  ImpactScene scene = flatCube(0.2, 0, 0.4, Vec3(0.5, 0.3, -2), Vec3(0.5, 0.5, 0.2));
  scene.resolve();
  EXPECT_LT(scene.states[0].velocity.norm(), 1e-15);
  EXPECT_LT(scene.states[0].angularMomentum.norm(), 1e-15);
}

}  // namespace
}  // namespace careen
