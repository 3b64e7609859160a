#include "physics/world/course.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace careen {
namespace {

// Whatever moves so, its velocities are the rates of its places, and its accelerations those of its
// velocities: by central differences, whose error is of second order in a step of 1e-4 s. 4.1e-7 off.
TEST(Driven, hasTheRatesOfItsPlaces) {
  const Driven driven{.pivot = Vec3(1, 2, 3),
                      .arm = Vec3(0.5, -1, 0.25),
                      .velocity = Vec3(0.3, 0, -1),
                      .spin = Vec3(0, 0, 2),
                      .amplitude = Vec3(0.1, 0.2, 0),
                      .swing = Vec3(0, 0, 0.4),
                      .rate = 3,
                      .phase = 0.7};
  constexpr double kStep = 1e-4;
  for (const double time : {0.0, 0.4, 1.7}) {
    const Kinematics now = driven.at(time);
    const Kinematics before = driven.at(time - kStep);
    const Kinematics after = driven.at(time + kStep);
    const auto rate = [&](const auto& of) { return Vec3((of(after) - of(before)) / (2 * kStep)); };
    EXPECT_LT((now.velocity - rate([](const Kinematics& k) { return k.pose.position; })).norm(), 8e-7);
    EXPECT_LT((now.acceleration - rate([](const Kinematics& k) { return k.velocity; })).norm(), 8e-7);
    EXPECT_LT((now.angularAcceleration - rate([](const Kinematics& k) { return k.angularVelocity; })).norm(),
              8e-7);
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 column = now.pose.worldFromBody.col(axis);
      const Vec3 turning = rate([&](const Kinematics& k) { return Vec3(k.pose.worldFromBody.col(axis)); });
      EXPECT_LT((now.angularVelocity.cross(column) - turning).norm(), 8e-7);
    }
  }
}

// A later start is the same motion.
TEST(Driven, goesOnFromAnyMoment) {
  const Driven driven{.pivot = Vec3(1, 0, 0),
                      .arm = Vec3(0, 1, 0),
                      .velocity = Vec3(0, 0, 1),
                      .spin = Vec3(0.5, 0, 0),
                      .amplitude = Vec3(0, 0.1, 0),
                      .rate = 5};
  const Kinematics later = driven.after(2).at(3);
  const Kinematics whole = driven.at(5);
  EXPECT_LT((later.pose.position - whole.pose.position).norm(), 4e-15);
  EXPECT_LT((later.pose.worldFromBody - whole.pose.worldFromBody).norm(), 4e-15);
  EXPECT_LT((later.velocity - whole.velocity).norm(), 4e-15);
}

// Bounds hold at a thousand moments, and the speed comes within a part in a hundred of its own where
// oscillation and turning add up.
TEST(Driven, staysWithinItsBounds) {
  const Driven driven{.arm = Vec3(0, 2, 0), .spin = Vec3(0, 0, 1), .amplitude = Vec3(0.5, 0, 0), .rate = 2};
  const MotionRates most = boundsOf(driven);
  double fastest = 0;
  for (int k = 0; k < 1000; ++k) {
    const Kinematics now = driven.at(0.0321 * k);
    fastest = std::max(fastest, now.velocity.norm());
    EXPECT_LE(now.velocity.norm(), most.speed);
    EXPECT_LE(now.acceleration.norm(), most.acceleration);
    EXPECT_LE(now.angularVelocity.norm(), most.angularSpeed);
    EXPECT_LE(now.angularAcceleration.norm(), most.angularAcceleration);
  }
  EXPECT_GT(fastest, 0.99 * most.speed);
}

TEST(Course, isStraightBetweenThePointsOfItsPath) {
  const Course course = courseOf({.path = {{1, Vec3(0, 0, 2)}, {3, Vec3(4, 0, 2)}, {4, Vec3(4, 1, 2)}}},
                                 {.position = Vec3(0, 0, 2)});
  const auto at = [&](double time) { return partAt(course, time).at(time); };
  EXPECT_EQ(at(0.5).pose.position, Vec3(0, 0, 2));
  EXPECT_EQ(at(0.5).velocity, Vec3::Zero());
  EXPECT_EQ(at(1).velocity, Vec3(2, 0, 0));  // of two parts that meet it is the later one
  EXPECT_EQ(at(2).pose.position, Vec3(2, 0, 2));
  EXPECT_EQ(at(3.5).pose.position, Vec3(4, 0.5, 2));
  EXPECT_EQ(at(9).pose.position, Vec3(4, 1, 2));
  EXPECT_EQ(at(9).velocity, Vec3::Zero());
  EXPECT_FALSE(partAt(course, 9).motion.moves());
  EXPECT_EQ(nextPart(course, 0), 1);
  EXPECT_EQ(nextPart(course, 1), 3);
  EXPECT_TRUE(std::isinf(nextPart(course, 4)));
}

// A quarter turn about a point that goes along: what was to its right is above it.
TEST(Course, turnsAboutAPointThatGoesAlong) {
  const Course course = courseOf({.path = {},
                                  .velocity = Vec3(0, 0, 1),
                                  .angularVelocity = Vec3(0, -std::numbers::pi / 2, 0),
                                  .about = Vec3(1, 0, 0)},
                                 {.position = Vec3(3, 0, 0)});
  const Kinematics after = course.front().at(1);
  EXPECT_LT((after.pose.position - Vec3(1, 0, 3)).norm(), 1e-15);
  EXPECT_LT((after.pose.worldFromBody * Vec3::UnitX() - Vec3::UnitZ()).norm(), 1e-15);
  EXPECT_LT((after.velocity - Vec3(-std::numbers::pi, 0, 1)).norm(), 2e-15);
}

// An oscillation that begins at its turning point begins there.
TEST(Course, beginsWhereItsPhaseSays) {
  const Course course =
      courseOf({.path = {}, .amplitude = Vec3(0.5, 0, 0), .rate = 2, .phase = std::numbers::pi / 2}, {});
  EXPECT_LT((course.front().at(0).pose.position - Vec3(0.5, 0, 0)).norm(), 1e-16);
  EXPECT_LT(course.front().at(0).velocity.norm(), 1e-15);
}

}  // namespace
}  // namespace careen
