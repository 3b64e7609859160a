#include "physics/impact_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/error.h"
#include "support/impact_scene.h"

namespace careen {
namespace {

using testing::aboutZ;
using testing::ImpactScene;
using testing::Quad;
using testing::Quad3;
using testing::Random;

double relativeChange(const Quad& after, const Quad& before) {
  return static_cast<double>(Quad((after - before) / before));
}

/// A cube of half size `half` above a floor, standing on its four lower corners (odd indices), turned about
/// z.
ImpactScene flatCube(double angle, double restitution, double friction, const Vec3& velocity,
                     const Vec3& half = Vec3(0.5, 0.5, 0.5), double mass = 2) {
  ImpactScene scene;
  BodyState state;
  state.pose.worldFromBody = aboutZ(angle);
  state.velocity = velocity;
  scene.addBox(half, mass, state);
  for (const int k : {1, 3, 5, 7}) {
    scene.addCorner(0, k, Vec3::UnitZ(), {.restitution = restitution, .friction = friction});
  }
  return scene;
}

/// A box that turns and flies, driven by its corner 7 into the corner of a room: each of the four corners of
/// the three faces there touches its wall, as when the box stands in the corner.
ImpactScene roomCorner(Random& random, double restitution) {
  ImpactScene scene;
  BodyState state;
  state.velocity = random.inCube(3) - Vec3(2, 2, 2);
  const Vec3 half{random.between(.1, 1), random.between(.1, 1), random.between(.1, 1)};
  const int box = scene.addBox(half, random.between(.5, 5), state);
  scene.states[0].angularMomentum = scene.masses[0].inertiaBody.cwiseProduct(random.inCube(3));
  for (int axis = 0; axis < 3; ++axis) {
    for (int k = 0; k < kCorners; ++k) {
      if (((k >> (2 - axis)) & 1) != 0) {
        scene.addCorner(box, k, Vec3(Vec3::Unit(axis)), {.restitution = restitution, .friction = 0});
      }
    }
  }
  return scene;
}

/// One or two free boxes that touch in up to `most` points at random, normals in a common half-space.
ImpactScene randomImpact(Random& random, int most, bool friction) {
  ImpactScene scene;
  const int bodies = 1 + random.below(2);
  for (int k = 0; k < bodies; ++k) {
    BodyState state;
    state.pose.worldFromBody = random.rotation();
    state.velocity = random.inCube(4);
    const Vec3 half{random.between(.05, 1), random.between(.05, 1), random.between(.05, 1)};
    scene.addBox(half, random.between(.1, 10), state);
    const Vec3 spin = state.pose.worldFromBody.transpose() * random.inCube(6);
    scene.states.back().angularMomentum =
        state.pose.worldFromBody * scene.masses.back().inertiaBody.cwiseProduct(spin);
  }
  const int count = 1 + random.below(most);
  const Vec3 common = random.direction();
  for (int k = 0; k < count; ++k) {
    Vec3 normal = (common + 0.8 * random.direction()).normalized();
    const bool wall = bodies == 1 || random.below(3) == 0;
    const int a = wall ? random.below(bodies) : 0;
    const int index = random.below(kCorners);  // named: the order of arguments' evaluation is the compiler's
    const Material material{.restitution = random.below(4) == 0 ? 1 : random.between(0, 1),
                            .friction = friction ? random.between(0, 1.5) : 0};
    scene.addCorner(a, index, normal, material);
    if (!wall) {
      scene.contacts.back().b = 1;
      scene.contacts.back().armB =
          scene.states[1].pose.worldFromBody * corner(scene.halfExtents[1], random.below(8));
    }
  }
  return scene;
}

/// Fig. 4 written again in quadruple precision, with the world inertia inverted as a matrix.
BodyState quadrupleFig4(const ImpactScene& scene, int body, double side) {
  const ImpactContact& c = scene.contacts[0];
  const Quad3 n = c.normal.cast<Quad>();
  Quad denominator = 0;
  for (const int k : {c.a, c.b}) {
    if (k < 0) {
      continue;
    }
    const auto i = static_cast<std::size_t>(k);
    const Matrix3<Quad> a = scene.states[i].pose.worldFromBody.cast<Quad>();
    const Matrix3<Quad> inverse =
        a * scene.masses[i].inverseInertiaBody.cast<Quad>().asDiagonal() * a.transpose();
    const Quad3 arm = (k == c.a ? c.armA : c.armB).cast<Quad>();
    const Quad3 turned = inverse * arm.cross(n);
    denominator += n.dot(n) * Quad(scene.masses[i].inverseMass) + turned.cross(arm).dot(n);
  }
  const Quad j = -(1 + Quad(c.material.restitution)) * scene.relativeVelocity(c).dot(n) / denominator;
  const auto i = static_cast<std::size_t>(body);
  BodyState after = scene.states[i];
  const Quad3 arm = (side > 0 ? c.armA : c.armB).cast<Quad>();
  after.velocity =
      (after.velocity.cast<Quad>() + n * (j * Quad(side) * Quad(scene.masses[i].inverseMass))).cast<double>();
  after.angularMomentum =
      (after.angularMomentum.cast<Quad>() + arm.cross(n) * (j * Quad(side))).cast<double>();
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
    const BodyState expectedB = c.b < 0 ? BodyState{} : quadrupleFig4(scene, c.b, -1);
    const double before = scene.partingSpeed(c);
    scene.resolve();
    const auto compare = [&](const BodyState& actual, const BodyState& expected) {
      worst = std::max(worst, (actual.velocity - expected.velocity).norm() / expected.velocity.norm());
      worst = std::max(worst, (actual.angularMomentum - expected.angularMomentum).norm() /
                                  expected.angularMomentum.norm());
    };
    compare(scene.states[static_cast<std::size_t>(c.a)], expectedA);
    if (c.b >= 0) {
      compare(scene.states[static_cast<std::size_t>(c.b)], expectedB);
    }
    EXPECT_NEAR(scene.partingSpeed(c), -c.material.restitution * before, 1e-13);
  }
  EXPECT_GT(hits, 5000);
  EXPECT_EQ(worst, 0);  // measured 0 over 10,000 hits: each component correctly rounded
}

TEST(ImpactLaw, cubeLandingFlatNeitherTiltsNorMovesSideways) {
  Random random(2);
  for (int k = 0; k < 2000; ++k) {
    const double e = k % 10 == 0 ? 0 : k % 10 == 1 ? 1 : random.between(0, 1);
    const double speed = random.between(0.001, 30);
    const Vec3 half{random.between(.05, 1), random.between(.05, 1), random.between(.05, 1)};
    ImpactScene scene = flatCube(k % 3 == 0 ? 0 : random.between(-3, 3), e, 0, Vec3(0, 0, -speed), half,
                                 random.between(.1, 10));
    scene.resolve();
    const BodyState& after = scene.states[0];
    EXPECT_EQ(after.velocity.x(), 0);
    EXPECT_EQ(after.velocity.y(), 0);
    EXPECT_EQ(after.angularMomentum, Vec3(Vec3::Zero()));
    if (e == 0) {
      EXPECT_EQ(after.velocity.z(), 0);
    } else {
      EXPECT_NEAR(after.velocity.z() / (e * speed), 1, 4e-16 * (1 + 1 / e));
    }
    // Four equals share evenly; to the bit those that the half-turn about z exchanges, which is exact at any
    // angle.
    EXPECT_EQ(scene.shares[0].impulse, scene.shares[3].impulse);
    EXPECT_EQ(scene.shares[1].impulse, scene.shares[2].impulse);
    EXPECT_NEAR(scene.shares[0].impulse / scene.shares[1].impulse, 1, 5e-15);  // measured 2e-15
  }
}

TEST(ImpactLaw, cubeLandingFlatKeepsItsSidewaysSpeedToTheBit) {
  ImpactScene scene = flatCube(0.3, 0.5, 0, Vec3(1.25, -0.7, -3));
  scene.resolve();
  EXPECT_EQ(scene.states[0].velocity.x(), 1.25);
  EXPECT_EQ(scene.states[0].velocity.y(), -0.7);
  EXPECT_EQ(scene.states[0].angularMomentum, Vec3(Vec3::Zero()));
}

TEST(ImpactLaw, boxLandingOnAnEdgeTurnsOnlyAboutIt) {
  ImpactScene scene;
  BodyState state;
  const double c = std::cos(0.4);
  const double s = std::sin(0.4);
  state.pose.worldFromBody << 1, 0, 0, 0, c, -s, 0, s, c;  // about x: the edge along x is lowest
  state.velocity = Vec3(0, 0, -2);
  scene.addBox(Vec3(0.3, 0.2, 0.1), 1.5, state);
  for (const int k : {3, 7}) {
    scene.addCorner(0, k, Vec3::UnitZ(), {.restitution = 1, .friction = 0});
  }
  const Quad before = scene.energy();
  scene.resolve();
  EXPECT_EQ(scene.states[0].angularMomentum.y(), 0);
  EXPECT_EQ(scene.states[0].angularMomentum.z(), 0);
  EXPECT_NE(scene.states[0].angularMomentum.x(), 0);
  EXPECT_EQ(scene.shares[0].impulse, scene.shares[1].impulse);
  EXPECT_NEAR(scene.partingSpeed(scene.contacts[0]), 2, 1e-15);
  EXPECT_LT(std::fabs(relativeChange(scene.energy(), before)), 1e-15);
}

TEST(ImpactLaw, cornerOfARoomKeepsEnergyAndReflectsWhatHitsIt) {
  Random random(3);
  double worst = 0;
  double deepest = 0;
  for (int k = 0; k < 2000; ++k) {
    ImpactScene scene = roomCorner(random, 1);
    const Quad before = scene.energy();
    scene.resolve();
    worst = std::max(worst, std::fabs(relativeChange(scene.energy(), before)));
    for (const ImpactContact& c : scene.contacts) {
      deepest = std::min(deepest, scene.partingSpeed(c));
    }
  }
  EXPECT_LT(worst, 5e-15);     // measured 9e-16
  EXPECT_GT(deepest, -1e-13);  // measured 0
  RecordProperty("energy", std::to_string(worst * 1e16) + "e-16");
  RecordProperty("approach", std::to_string(deepest * 1e16) + "e-16");
}

TEST(ImpactLaw, cubeFlyingStraightIntoARoomsCornerComesStraightBack) {
  Random random(4);
  ImpactScene scene = roomCorner(random, 1);
  scene.states[0].velocity = Vec3(-1, -2, -3);
  scene.states[0].angularMomentum.setZero();
  scene.resolve();
  EXPECT_LT((scene.states[0].velocity - Vec3(1, 2, 3)).norm(), 1e-14);
  EXPECT_EQ(scene.states[0].angularMomentum, Vec3(Vec3::Zero()));
}

/// Cubes of half size 1/2 in a row along x, touching with whole faces; the first one comes with speed 1.
ImpactScene row(int n, double restitution) {
  ImpactScene scene;
  for (int k = 0; k < n; ++k) {
    BodyState state;
    state.pose.position = Vec3(k, 0, 0);
    state.velocity = Vec3(k == 0 ? 1 : 0, 0, 0);
    scene.addBox(Vec3(0.5, 0.5, 0.5), 3, state);
  }
  for (int k = 0; k + 1 < n; ++k) {
    for (const double y : {-0.5, 0.5}) {
      for (const double z : {-0.5, 0.5}) {
        scene.contacts.push_back({.a = k + 1,
                                  .b = k,
                                  .armA = Vec3(-0.5, y, z),
                                  .armB = Vec3(0.5, y, z),
                                  .normal = Vec3::UnitX(),
                                  .material = {.restitution = restitution, .friction = 0}});
      }
    }
  }
  return scene;
}

TEST(ImpactLaw, lastBlockOfARowLeavesWithAllTheSpeed) {
  ImpactScene scene = row(6, 1);
  scene.resolve();
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_NEAR(scene.states[k].velocity.x(), k == 5 ? 1 : 0, 1e-15) << k;
    EXPECT_EQ(scene.states[k].velocity.y(), 0);
    EXPECT_EQ(scene.states[k].velocity.z(), 0);
    EXPECT_EQ(scene.states[k].angularMomentum, Vec3(Vec3::Zero()));
  }
}

TEST(ImpactLaw, plasticRowMovesOnTogether) {
  ImpactScene scene = row(5, 0);
  scene.resolve();
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(scene.states[k].velocity.x(), 0.2, 1e-15) << k;
  }
}

TEST(ImpactLaw, restitutionOfEachContactCountsWhereTheyDoNotMeet) {
  // A box slides into a corner of two walls: e = 1 on the wall at −x, e = 0 on the floor.
  ImpactScene scene;
  BodyState state;
  state.velocity = Vec3(-2, 0.5, -3);
  scene.addBox(Vec3(0.5, 0.4, 0.3), 1, state);
  for (const int k : {1, 3, 5, 7}) {
    scene.addCorner(0, k, Vec3::UnitZ(), {.restitution = 0.25, .friction = 0});
  }
  for (const int k : {4, 5, 6, 7}) {
    scene.addCorner(0, k, Vec3::UnitX(), {.restitution = 1, .friction = 0});
  }
  scene.resolve();
  EXPECT_LT((scene.states[0].velocity - Vec3(2, 0.5, 0.75)).norm(), 2e-15);
  EXPECT_LT(scene.states[0].angularMomentum.norm(), 1e-15);
}

TEST(ImpactLaw, manyContactsGainNoEnergyKeepMomentumAndLeaveNothingApproaching) {
  Random random(5);
  double gained = 0;
  double deepest = 0;
  double momentum = 0;
  for (int k = 0; k < 4000; ++k) {
    ImpactScene scene = randomImpact(random, 12, false);
    const Quad before = scene.energy();
    const ImpactScene start = scene;
    scene.resolve();
    gained = std::max(gained, relativeChange(scene.energy(), before));
    double speed = 0;
    for (const ImpactContact& c : scene.contacts) {
      speed = std::max(speed, static_cast<double>(Quad(start.relativeVelocity(c).norm())));
    }
    Vec3 expected = Vec3::Zero();
    double size = 0;
    for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
      deepest = std::max(deepest, -scene.partingSpeed(scene.contacts[c]) / speed);
      EXPECT_GE(scene.shares[c].impulse, 0);
      if (scene.contacts[c].b == ImpactContact::kWall) {
        expected += scene.shares[c].impulse * scene.contacts[c].normal;
        size += scene.shares[c].impulse;
      }
    }
    for (std::size_t b = 0; b < scene.states.size(); ++b) {
      expected -= scene.masses[b].mass * (scene.states[b].velocity - start.states[b].velocity);
      size += scene.masses[b].mass * (scene.states[b].velocity.norm() + start.states[b].velocity.norm());
    }
    momentum = std::max(momentum, expected.norm() / size);
  }
  EXPECT_LT(gained, 1e-14);    // measured 1.1e-15
  EXPECT_LT(deepest, 1e-13);   // measured 0
  EXPECT_LT(momentum, 1e-15);  // measured 2e-16
  RecordProperty("gained", std::to_string(gained * 1e16) + "e-16");
  RecordProperty("approach", std::to_string(deepest * 1e16) + "e-16");
  RecordProperty("momentum", std::to_string(momentum * 1e16) + "e-16");
}

bool sameBits(const BodyState& a, const BodyState& b) {
  return a.velocity == b.velocity && a.angularMomentum == b.angularMomentum;
}

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
      ASSERT_TRUE(sameBits(scene.states[b], other.states[b])) << k;
    }
    for (std::size_t i = 0; i < order.size(); ++i) {
      ASSERT_EQ(other.shares[i].impulse, scene.shares[order[i]].impulse) << k;
      ASSERT_EQ(other.shares[i].tangential, scene.shares[order[i]].tangential) << k;
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

TEST(ImpactLaw, boxesHittingEachOtherKeepMomentumAboutAnyPoint) {
  Random random(9);
  double worst = 0;
  for (int k = 0; k < 5000; ++k) {
    ImpactScene scene = randomImpact(random, 1, k % 2 == 0);
    if (scene.states.size() != 2 || scene.contacts[0].b < 0) {
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

// ---- friction ----

TEST(ImpactLaw, millionRandomImpactsWithFrictionGainNoEnergy) {
  Random random(11);
  double gained = -1;
  double cone = 0;
  for (int k = 0; k < 1000000; ++k) {
    ImpactScene scene = randomImpact(random, 1, true);
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
    gained = std::max(gained, (energy() - before) / before);
    const ImpactShare& share = scene.shares[0];
    cone = std::max(cone, share.tangential - scene.contacts[0].material.friction * share.impulse);
  }
  EXPECT_LT(gained, 1e-14);  // measured 0: losses outweigh rounding
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
  EXPECT_LT(deepest, 1e-12);
  EXPECT_LT(cone, 1e-12);
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

TEST(ImpactLaw, nothingThatPartsIsTouched) {
  ImpactScene scene = flatCube(0.2, 0.5, 0.4, Vec3(0.5, 0.3, 2));
  const BodyState before = scene.states[0];
  scene.resolve();
  EXPECT_TRUE(sameBits(before, scene.states[0]));
  for (const ImpactShare& share : scene.shares) {
    EXPECT_EQ(share.impulse, 0);
    EXPECT_EQ(share.approach, -2);
  }
}

TEST(ImpactLaw, refusesWhatCannotMoveAndWhatIsNoNumber) {
  ImpactScene scene = flatCube(0, 0.5, 0, Vec3(0, 0, -1));
  scene.masses[0] = immovable();
  EXPECT_THROW(scene.resolve(), NumericalError);
  scene.contacts.resize(1);
  EXPECT_THROW(scene.resolve(), NumericalError);
}

}  // namespace
}  // namespace careen
