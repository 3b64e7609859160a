#include "physics/compared/impulse.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "support/article_equations.h"

namespace careen {
namespace {

/// Two bodies about to touch, in no special position; B may be a wall.
struct Pair {
  MassProperties massA = solidBox({0.1, 0.2, 0.3}, 2);
  MassProperties massB = solidBox({0.4, 0.15, 0.25}, 3);
  BodyState a;
  BodyState b;
  Vec3 point = Vec3(0.05, 0.12, 0.2);
  Vec3 normal = Vec3(1, 2, 2) / 3;

  Pair() {
    a.pose = {.position = {0.2, 0.3, 0.35}, .worldFromBody = axisAngle(Vec3(2, -1, 2) / 3, 1.1)};
    a.velocity = {-1, -2, -3};
    a.angularMomentum = angularMomentum(massA, a.pose.worldFromBody, {3, -1, 2});
    b.pose = {.position = {-0.1, -0.1, 0.1}, .worldFromBody = axisAngle(Vec3(1, 2, 2) / 3, 0.4)};
    b.velocity = {0.5, 1, 0};
    b.angularMomentum = angularMomentum(massB, b.pose.worldFromBody, {-1, 2, 1});
  }
  CollidingBody first() { return {massA, a}; }
  CollidingBody second() { return {massB, b}; }
  double speed() { return normalVelocity(first(), second(), point, normal); }
  double impulse(double e) { return collisionImpulse(first(), second(), point, normal, e); }
  void collide(double e) {
    const Vec3 given = impulse(e) * normal;
    applyImpulse(first(), point, given);
    applyImpulse(second(), point, -given);
  }
};

double kineticEnergy(const Pair& pair) {
  return kineticEnergy(pair.massA, pair.a) + kineticEnergy(pair.massB, pair.b);
}
Vec3 momentum(const Pair& pair) {
  return pair.massA.mass * pair.a.velocity + pair.massB.mass * pair.b.velocity;
}
Vec3 angularMomentumAboutOrigin(const Pair& pair) {
  const auto of = [](const MassProperties& mass, const BodyState& state) -> Vec3 {
    return state.pose.position.cross(mass.mass * state.velocity) + state.angularMomentum;
  };
  return of(pair.massA, pair.a) + of(pair.massB, pair.b);
}

constexpr std::array kRestitutions = {0.0, 0.5, 1.0};

// Straight through the centre nothing turns: j = (1+e) M |v|.
TEST(CollisionImpulse, throughTheCenterOnAWallIsMassTimesSpeed) {
  const MassProperties mass = solidBox({0.2, 0.2, 0.2}, 2);
  const MassProperties wall = immovable();
  BodyState box{.velocity = {0, 0, -3}};
  BodyState still;
  for (const double e : kRestitutions) {
    EXPECT_EQ(collisionImpulse({mass, box}, {wall, still}, {0, 0, -0.2}, Vec3::UnitZ(), e), (1 + e) * 2 * 3);
  }
}

// A plank of 1 kg and half sizes (3, 0.1, 0.1) m strikes with its end: I_y = (9 + 0.01)/3, lever 3 m.
TEST(CollisionImpulse, atTheEndOfAPlankIsWorkedOutByHand) {
  const MassProperties mass = solidBox({3, 0.1, 0.1}, 1);
  const MassProperties wall = immovable();
  BodyState plank{.velocity = {0, 0, -2}};
  BodyState still;
  // r = (3, 0, −0.1), n = z: (I⁻¹ (r × n)) × r · n = 9 / I_y.
  const double expected = 1.5 * 2 / (1 + 9 * 3 / 9.01);
  EXPECT_NEAR(collisionImpulse({mass, plank}, {wall, still}, {3, 0, -0.1}, Vec3::UnitZ(), 0.5), expected,
              1e-15);  // measured 0
}

// Newton's own: equal balls in line exchange speeds for e = 1, share them for e = 0.
TEST(CollisionImpulse, betweenEqualBodiesInLineExchangesOrSharesSpeed) {
  const MassProperties mass = solidBox({0.5, 0.5, 0.5}, 2);
  for (const double e : kRestitutions) {
    BodyState left{.velocity = {3, 0, 0}};
    BodyState right{.velocity = {1, 0, 0}};
    left.pose.position.x() = -0.5;
    right.pose.position.x() = 0.5;
    const Vec3 impulse =
        collisionImpulse({mass, left}, {mass, right}, Vec3::Zero(), -Vec3::UnitX(), e) * -Vec3::UnitX();
    applyImpulse({mass, left}, Vec3::Zero(), impulse);
    applyImpulse({mass, right}, Vec3::Zero(), -impulse);
    EXPECT_EQ(left.velocity, Vec3(2 - e, 0, 0));
    EXPECT_EQ(right.velocity, Vec3(2 + e, 0, 0));
    EXPECT_EQ(left.angularMomentum, Vec3::Zero());
  }
}

TEST(CollisionImpulse, sendsThePointsApartAtRestitutionTimesTheirSpeed) {
  for (const double e : kRestitutions) {
    Pair pair;
    const double before = pair.speed();
    ASSERT_LT(before, -4) << "measured -4.5: they are closing in";
    pair.collide(e);
    EXPECT_NEAR(pair.speed(), -e * before, 2e-14);  // measured 8.9e-16
  }
}

TEST(CollisionImpulse, keepsLinearAndAngularMomentumOfThePair) {
  for (const double e : kRestitutions) {
    Pair pair;
    const Vec3 linear = momentum(pair);
    const Vec3 angular = angularMomentumAboutOrigin(pair);
    const Vec3 velocity = pair.a.velocity;
    pair.collide(e);
    EXPECT_GT((pair.a.velocity - velocity).norm(), 0.5) << "something happened";
    EXPECT_LT((momentum(pair) - linear).norm(), 1e-14);                     // measured 0
    EXPECT_LT((angularMomentumAboutOrigin(pair) - angular).norm(), 1e-14);  // measured 3.7e-16
  }
}

TEST(CollisionImpulse, takesOutTheEnergyItShould) {
  for (const double e : kRestitutions) {
    Pair pair;
    const double approach = -pair.speed();
    const double impulse = pair.impulse(e);
    const double energy = kineticEnergy(pair);
    pair.collide(e);
    const double change = kineticEnergy(pair) - energy;
    EXPECT_NEAR(change, impactEnergyChange(approach, impulse, e), 2e-14);  // measured 2.7e-15
    if (e == 1) {
      EXPECT_LT(std::abs(change) / energy, 1e-15);  // measured 0
    } else {
      EXPECT_LT(change, -1) << "measured -7.4 for e = 0.5, -9.8 for e = 0";
    }
  }
}

TEST(CollisionImpulse, onAWallMovesOnlyTheBody) {
  for (const double e : kRestitutions) {
    Pair pair;
    pair.massB = immovable();
    pair.b = BodyState{};
    const double approach = -pair.speed();
    const double impulse = pair.impulse(e);
    const double energy = kineticEnergy(pair);
    const BodyState before = pair.a;
    pair.collide(e);
    EXPECT_NEAR(pair.speed(), e * approach, 2e-14);  // measured 4.4e-16
    EXPECT_NEAR(kineticEnergy(pair) - energy, impactEnergyChange(approach, impulse, e),
                4e-14);  // measured 1.8e-15
    EXPECT_EQ(pair.b.velocity, Vec3::Zero());
    EXPECT_EQ(pair.b.angularMomentum, Vec3::Zero());
    EXPECT_EQ(pair.a.pose.position, before.pose.position);
    // p changes by J, L by r × J.
    const Vec3 given = impulse * pair.normal;
    EXPECT_LT((2 * (pair.a.velocity - before.velocity) - given).norm(), 1e-14);  // measured 0
    const Vec3 turned = (pair.point - pair.a.pose.position).cross(given);
    EXPECT_LT((pair.a.angularMomentum - before.angularMomentum - turned).norm(), 1e-15);  // measured 5.6e-17
  }
}

TEST(CollisionImpulse, onAWallIsTheLimitOfAHeavyBody) {
  Pair wall;
  wall.massB = immovable();
  wall.b = BodyState{};
  Pair heavy = wall;
  heavy.massB = solidBox({1, 1, 1}, 1e9);
  EXPECT_NEAR(heavy.impulse(0.5) / wall.impulse(0.5), 1, 1e-8);  // measured 1.6e-09
  EXPECT_NE(heavy.impulse(0.5), wall.impulse(0.5));
}

// The n·n in Fig. 4 is there so that n need not be unit: j n stays.
TEST(CollisionImpulse, givesTheSameImpulseForALongerNormal) {
  Pair pair;
  const Vec3 unit = pair.impulse(0.5) * pair.normal;
  pair.normal *= 4;
  EXPECT_LT((pair.impulse(0.5) * pair.normal - unit).norm(), 1e-14);  // measured 0
}

TEST(CollisionImpulse, isTheSameWithTheBodiesNamedTheOtherWay) {
  Pair pair;
  const double impulse = pair.impulse(0.5);
  const double other = collisionImpulse(pair.second(), pair.first(), pair.point, -pair.normal, 0.5);
  EXPECT_NEAR(other, impulse, 1e-14);  // measured 8.9e-16
}

// A free cube struck at a corner turns about the axis r × n.
TEST(ApplyImpulse, turnsABodyAboutArmCrossImpulse) {
  const MassProperties mass = solidBox({1, 1, 1}, 3);  // I = 2
  BodyState cube;
  applyImpulse({mass, cube}, {1, 1, 1}, {0, 0, 6});
  EXPECT_EQ(cube.velocity, Vec3(0, 0, 2));
  EXPECT_EQ(angularVelocity(mass, cube), Vec3(3, -3, 0));
}

}  // namespace
}  // namespace careen
