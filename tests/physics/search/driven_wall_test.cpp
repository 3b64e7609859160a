#include "physics/search/driven_wall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "physics/search/first_contact_search.h"
#include "physics/world/course.h"
#include "support/tumbling_box.h"

namespace careen {
namespace {

using test::Dice;
using test::TumblingBox;

TumblingBox tossedBox(Dice& dice) {
  const auto any = [&](double size) {
    return Vec3(dice.between(-size, size), dice.between(-size, size), dice.between(-size, size));
  };
  return {.halfExtents = Vec3(dice.between(0.05, 0.3), dice.between(0.05, 0.3), dice.between(0.05, 0.3)),
          .position = any(1) + Vec3(0, 0, 2),
          .velocity = any(2),
          .gravity = Vec3(0, 0, -9.81),
          .momentumAxis = any(1).normalized(),
          .spinAxis = any(1).normalized(),
          .precession = dice.between(-6, 6),
          .spin = dice.between(-6, 6)};
}

Course courseBy(Dice& dice, bool turns) {
  const auto any = [&](double size) {
    return Vec3(dice.between(-size, size), dice.between(-size, size), dice.between(-size, size));
  };
  const Vec3 axis = any(1).normalized();
  return courseOf({.path = {},
                   .velocity = any(0.5),
                   .angularVelocity = (turns ? dice.between(-1, 1) : 0) * axis,
                   .about = any(2),
                   .amplitude = any(0.3),
                   .swing = (turns ? dice.between(-0.4, 0.4) : 0) * axis,
                   .rate = dice.between(1, 12),
                   .phase = dice.between(0, 6)},
                  {.position = any(0.3)});
}

// The lowest corner over the wall at that time.
double gapAt(const TumblingBox& box, const DrivenWall& wall, double time) {
  const Vec3 normal = wall.normalAt(time);
  const double offset = wall.offsetAt(time);
  double lowest = kNever;
  for (const Vec3& corner : box.corners<double>(time)) {
    lowest = std::min(lowest, dot(normal, corner) - offset);
  }
  return lowest;
}

// What is found is a root that no earlier moment has: of 600 flights, the gap at it is 8e-15 m at the most.
TEST(DrivenWall, theFirstRootIsFound) {
  Dice dice(3);
  int hits = 0;
  double farthest = 0;
  for (int toss = 0; toss < 600; ++toss) {
    const TumblingBox box = tossedBox(dice);
    const Vec3 normal = Vec3(dice.between(-0.5, 0.5), dice.between(-0.5, 0.5), 1).normalized();
    const Course course = courseBy(dice, toss % 2 == 0);
    const DrivenWall driven{.normal = normal, .driven = course.front().motion, .age = dice.between(0, 1)};
    if (gapAt(box, driven, 0) < 0.01) {
      continue;
    }
    const FirstContact contact = firstContactWithWall(box.moving(), driven, {.from = 0, .until = 1.5});
    const double until = contact.kind == ContactKind::kNone ? 1.5 : contact.time;
    for (int k = 0; k < 3000; ++k) {
      ASSERT_GT(gapAt(box, driven, until * k / 3000), -1e-12) << toss;
    }
    if (contact.kind == ContactKind::kImpact) {
      ++hits;
      farthest = std::max(farthest, std::fabs(gapAt(box, driven, contact.time)));
      const double h = 1e-6;
      EXPECT_NEAR(contact.approach,
                  (gapAt(box, driven, contact.time - h) - gapAt(box, driven, contact.time)) / h, 1e-3);
    }
  }
  EXPECT_GT(hits, 300);
  EXPECT_LT(farthest, 2e-14);
}

// A wall that goes straight on is still as seen from it.
TEST(DrivenWall, aUniformOneIsStillAsSeenFromIt) {
  Dice dice(4);
  for (int toss = 0; toss < 50; ++toss) {
    const TumblingBox box = tossedBox(dice);
    const Course course = courseOf({.path = {}, .velocity = Vec3(1, 0, 0.5)}, {});
    const DrivenWall driven{.normal = Vec3::UnitZ(), .driven = course.front().motion, .age = 0.25};
    ASSERT_TRUE(driven.isUniform());
    if (gapAt(box, driven, 0) < 0.01) {
      continue;
    }
    EXPECT_EQ(driven.offsetAt(0), 0.125);
    const MovingBox moving = box.moving();
    const FirstContact seen =
        firstContactWithWall(seenFrom(driven, moving), Vec3::UnitZ(), 0.125, {.from = 0, .until = 2});
    const FirstContact found = firstContactWithWall(moving, driven, {.from = 0, .until = 2});
    ASSERT_EQ(seen.kind, found.kind);
    EXPECT_NEAR(seen.time, found.time, 1e-13);
    EXPECT_NEAR(seen.approach, found.approach, 1e-12);
  }
}

// A box at rest is met where A sin ωt is its gap.
TEST(DrivenWall, whatRestsIsMet) {
  const TumblingBox box{.halfExtents = Vec3::Constant(0.1), .position = Vec3(0, 0, 0.2)};
  const Course course = courseOf({.path = {}, .amplitude = Vec3(0, 0, 0.2), .rate = 2}, {});
  const FirstContact met =
      firstContactWithWall(box.moving(), {Vec3::UnitZ(), course.front().motion, 0}, {.from = 0, .until = 2});
  EXPECT_EQ(met.kind, ContactKind::kImpact);
  EXPECT_NEAR(met.time, std::asin(0.5) / 2, 1e-15);
  EXPECT_NEAR(met.approach, 0.4 * std::cos(std::asin(0.5)), 1e-14);
}

}  // namespace
}  // namespace careen
