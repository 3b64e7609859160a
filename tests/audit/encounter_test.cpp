#include "audit/encounter.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "audit/flown.h"
#include "support/exact_runs.h"

namespace careen {
namespace {

const Vec3 kDown(0, 0, -10);

// A cube of 2 m, 1 kg, above a floor at z = 0.
struct OnFloor {
  Body cube = box("cube", Vec3::Ones(), 1, Vec3(0, 0, 1));
  Wall floor;
  ObservedEncounter encounter;
  OnFloor(double restitution, double friction, double seconds) {
    floor.material = {.restitution = restitution, .friction = friction};
    cube.material = floor.material;
    encounter = {
        .body = &cube, .wall = &floor, .gravity = kDown, .seconds = seconds, .near = 1e-3, .part = 0.01};
  }
  // It strikes the floor `before` the second row with 2 m/s, flat, and leaves it with `up` [m/s].
  void bounce(double before, double up) {
    const BodyState down{.pose = {.position = Vec3(0, 0, 1)}, .velocity = Vec3(0.3, 0, -2)};
    const BodyState left{.pose = {.position = Vec3(0, 0, 1)}, .velocity = Vec3(0.3, 0, up)};
    encounter.before = flown(cube.mass, down, kDown, -(encounter.seconds - before));
    encounter.after = flown(cube.mass, left, kDown, before);
  }
  // It slides from row to row, slowed down by `friction` times its weight.
  void slide(double speed, double friction) {
    encounter.before = {.pose = {.position = Vec3(0, 0, 1)}, .velocity = Vec3(speed, 0, 0)};
    encounter.after = {.pose = {.position = Vec3(speed * encounter.seconds, 0, 1)},
                       .velocity = Vec3(speed - 10 * friction * encounter.seconds, 0, 0)};
  }
};

// Speeds may be off by 1 % of 2.3 m/s, so that e is known to 0.03.
TEST(ObservedEncounter, aBounceTellsItsRestitution) {
  for (const double restitution : {0.0, 0.3, 0.5, 1.0}) {
    for (const double seconds : {0.05, 0.02, 0.008}) {
      for (const double part : {0.2, 0.5, 0.9}) {
        OnFloor right(restitution, 0, seconds);
        right.bounce(part * seconds, 2 * restitution);
        EXPECT_EQ(restitutionBeyond(right.encounter), 0) << restitution << ' ' << seconds << ' ' << part;
        OnFloor high(0.4, 0, seconds);
        high.bounce(part * seconds, 2);
        EXPECT_NEAR(restitutionBeyond(high.encounter), 0.6, 0.05);
        OnFloor low(1, 0, seconds);
        low.bounce(part * seconds, 1);
        EXPECT_NEAR(restitutionBeyond(low.encounter), 0.5, 0.05);
      }
    }
  }
}

TEST(ObservedEncounter, whatSlidesIsSlowedDown) {
  const auto of = [](double friction, double acts, double seconds) {
    OnFloor slides(0, friction, seconds);
    slides.slide(1, acts);
    return frictionOf(slides.encounter).value();
  };
  EXPECT_NEAR(of(0.5, 0.5, 0.01).missing.value(), 0, 1e-15);
  EXPECT_NEAR(of(0.5, 0, 0.01).missing.value(), 0.05, 1e-15);
  EXPECT_NEAR(of(0.5, 0.2, 0.01).missing.value(), 0.03, 1e-15);
  EXPECT_NEAR(of(0.5, 0.7, 0.01).surplus, 0.02, 1e-15);
  EXPECT_LE(of(0.5, 0.5, 0.01).surplus, 1e-15);
  // At rest it need not be slowed down; nor need it where it may have stopped between the rows.
  OnFloor rests(0, 0.5, 0.01);
  rests.slide(0, 0);
  EXPECT_FALSE(frictionOf(rests.encounter)->missing);
  OnFloor stops(0, 0.5, 0.4);
  stops.slide(1, 0.1);
  EXPECT_FALSE(frictionOf(stops.encounter)->missing);
}

// What one body got from another it passed on to the floor.
TEST(ObservedEncounter, whatWasPassedOnCounts) {
  OnFloor below(0, 0.5, 0.01);
  below.slide(1, 1);  // 0.5 of its own weight, 0.5 of a rider's of the same
  EXPECT_NEAR(frictionOf(below.encounter)->surplus, 0.05, 1e-15);
  below.encounter.passed = Vec3(0, 0, 0.1);
  EXPECT_NEAR(frictionOf(below.encounter)->surplus, 0, 1e-15);
}

// It hovers: from 5 mm above the floor a fall takes 0.0316 s.
TEST(ObservedEncounter, whatHoversWasNotTouched) {
  OnFloor hovers(0, 0, 0.05);
  hovers.encounter.before = {.pose = {.position = Vec3(0, 0, 1.005)}};
  hovers.encounter.after = hovers.encounter.before;
  EXPECT_GT(leastDistance(std::array{hovers.encounter}), 1e-3);
  hovers.encounter.seconds = 0.08;
  EXPECT_LT(leastDistance(std::array{hovers.encounter}), 1e-3);
  OnFloor bounces(1, 0, 0.02);
  bounces.bounce(0.01, 2);
  EXPECT_LT(leastDistance(std::array{bounces.encounter}), 1e-3);
}

TEST(ObservedEncounter, boxesTouchAlongTheAxisThatPartsThem) {
  const Body slab = box("slab", Vec3(5, 5, 1), 1, Vec3(0, 0, -1));
  OnFloor on(0, 0, 0.01);
  on.encounter.wall = nullptr;
  on.encounter.other = &slab;
  const std::optional<Touch> touch = touchOf(on.encounter, on.cube.initial, slab.initial);
  ASSERT_TRUE(touch);
  EXPECT_LT((touch->normal - Vec3::UnitZ()).norm(), 1e-15);
  EXPECT_NEAR(touch->gap, 0, 1e-15);
  EXPECT_LT(touch->points[0].place.cwiseAbs().maxCoeff(), 2.1)
      << "not a corner of the cube, which is smaller";
  // Edge on edge: two faces part them alike.
  BodyState aside = on.cube.initial;
  aside.pose.position = Vec3(6, 0, 1);
  EXPECT_FALSE(touchOf(on.encounter, aside, slab.initial));
}

TEST(ObservedEncounter, pointsOfBothMove) {
  OnFloor on(0, 0, 0.01);
  const Body slab = box("slab", Vec3(5, 5, 1), 1, Vec3(0, 0, -1));
  on.encounter.other = &slab;
  EXPECT_EQ(approachAt(on.encounter, {.velocity = Vec3(1, 0, 0)}, {.velocity = Vec3(0, 0, 2)}, Vec3::Zero()),
            Vec3(1, 0, -2));
}

}  // namespace
}  // namespace careen
