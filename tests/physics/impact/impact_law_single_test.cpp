#include "physics/impact/impact_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "support/impact_scene.h"

namespace careen {
namespace {

using test::ImpactScene;
using test::Quad;
using test::Quad3;
using test::Random;
using test::randomImpact;
using test::relativeChange;

/// Fig. 4 written again in quadruple precision, with the world inertia inverted as a matrix.
BodyState quadrupleFig4(const ImpactScene& scene, int body, double sign) {
  const ImpactContact& c = scene.contacts[0];
  const Quad3 n = c.normal.cast<Quad>();
  Quad denominator = 0;
  for (const int side : {c.a, c.b}) {
    if (side == scene.wall()) {
      continue;
    }
    const auto i = static_cast<std::size_t>(side);
    const Matrix3<Quad> a = scene.states[i].pose.worldFromBody.cast<Quad>();
    const Matrix3<Quad> inverse =
        a * scene.masses[i].inverseInertiaBody.cast<Quad>().asDiagonal() * a.transpose();
    const Quad3 arm = (side == c.a ? c.armA : c.armB).cast<Quad>();
    const Quad3 turned = inverse * arm.cross(n);
    denominator += n.dot(n) * Quad(scene.masses[i].inverseMass) + turned.cross(arm).dot(n);
  }
  const Quad j = -(1 + Quad(c.material.restitution)) * scene.relativeVelocity(c).dot(n) / denominator;
  const auto i = static_cast<std::size_t>(body);
  BodyState after = scene.states[i];
  const Quad3 arm = (sign > 0 ? c.armA : c.armB).cast<Quad>();
  after.velocity =
      (after.velocity.cast<Quad>() + n * (j * Quad(sign) * Quad(scene.masses[i].inverseMass))).cast<double>();
  after.angularMomentum =
      (after.angularMomentum.cast<Quad>() + arm.cross(n) * (j * Quad(sign))).cast<double>();
  return after;
}

TEST(ImpactLaw, oneContactIsFig4ToTheLastBit) {
  Random random(1);
  double worst = 0;
  int hits = 0;
  for (int k = 0; k < 20000; ++k) {
    ImpactScene scene = randomImpact(random, 1, false);
    if (scene.partingSpeed(scene.contacts[0]) >= 0) {
      continue;
    }
    ++hits;
    const ImpactContact& c = scene.contacts[0];
    const BodyState expectedA = quadrupleFig4(scene, c.a, 1);
    const BodyState expectedB = c.b == scene.wall() ? BodyState{} : quadrupleFig4(scene, c.b, -1);
    const double before = scene.partingSpeed(c);
    scene.resolve();
    const auto compare = [&](const BodyState& actual, const BodyState& expected) {
      worst = std::max(worst, (actual.velocity - expected.velocity).norm() / expected.velocity.norm());
      worst = std::max(worst, (actual.angularMomentum - expected.angularMomentum).norm() /
                                  expected.angularMomentum.norm());
    };
    compare(scene.states[static_cast<std::size_t>(c.a)], expectedA);
    if (c.b != scene.wall()) {
      compare(scene.states[static_cast<std::size_t>(c.b)], expectedB);
    }
    EXPECT_NEAR(scene.partingSpeed(c), -c.material.restitution * before, 1e-13);
  }
  EXPECT_GT(hits, 5000);
  EXPECT_EQ(worst, 0);  // measured 0 over 10,000 hits: each component correctly rounded
}

TEST(ImpactLaw, boxesHittingEachOtherKeepMomentumAboutAnyPoint) {
  Random random(9);
  double worst = 0;
  for (int k = 0; k < 5000; ++k) {
    ImpactScene scene = randomImpact(random, 1, k % 2 == 0);
    if (scene.states.size() != 2 || scene.contacts[0].b == scene.wall()) {
      continue;
    }
    // Where they touch fixes where they are: the point is the origin.
    const auto total = [&]() {
      const ImpactContact& c = scene.contacts[0];
      const Quad3 pa = scene.states[0].velocity.cast<Quad>() / Quad(scene.masses[0].inverseMass);
      const Quad3 pb = scene.states[1].velocity.cast<Quad>() / Quad(scene.masses[1].inverseMass);
      const Quad3 l = scene.states[0].angularMomentum.cast<Quad>() +
                      scene.states[1].angularMomentum.cast<Quad>() - c.armA.cast<Quad>().cross(pa) -
                      c.armB.cast<Quad>().cross(pb);
      return std::pair<Quad3, Quad3>(pa + pb, l);
    };
    const auto before = total();
    double p = 0;
    double l = 0;
    for (std::size_t b = 0; b < 2; ++b) {
      p += scene.states[b].velocity.norm() * scene.masses[b].mass;
      l += scene.states[b].angularMomentum.norm() +
           scene.states[b].velocity.norm() * scene.masses[b].mass * scene.halfExtents[b].norm();
    }
    scene.resolve();
    const auto after = total();
    worst = std::max(worst, static_cast<double>(Quad((after.first - before.first).norm())) / p);
    worst = std::max(worst, static_cast<double>(Quad((after.second - before.second).norm())) / l);
  }
  EXPECT_LT(worst, 1e-15);  // measured 1.2e-16
  RecordProperty("worst", std::to_string(worst * 1e16) + "e-16");
}

TEST(ImpactLaw, energyHoldsThroughAMillionBounces) {
  Random random(10);
  ImpactScene scene;
  BodyState state;
  state.pose.worldFromBody = random.rotation();
  state.velocity = Vec3(2, -3, 5);
  scene.addBox(Vec3(0.1, 0.2, 0.3), 1, state);
  scene.states[0].angularMomentum = 0.1 * random.direction();
  scene.addCorner(0, 0, Vec3::UnitZ(), {.restitution = 1, .friction = 0});
  const Quad before = scene.energy();
  double worst = 0;
  for (int k = 0; k < 1000000;) {
    scene.contacts[0].armA =
        scene.states[0].pose.worldFromBody * corner(scene.halfExtents[0], random.below(8));
    const int axis = random.below(3);
    scene.contacts[0].normal = random.below(2) == 0 ? Vec3(Vec3::Unit(axis)) : Vec3(-Vec3::Unit(axis));
    scene.resolve();
    k += scene.shares[0].impulse > 0 ? 1 : 0;
    if (k % 1000 == 0) {
      worst = std::max(worst, std::fabs(relativeChange(scene.energy(), before)));
    }
  }
  EXPECT_LT(worst, 1e-12);  // measured 2.8e-14; asked for: 5e-12
  RecordProperty("drift", std::to_string(worst * 1e13) + "e-13");
}

}  // namespace
}  // namespace careen
