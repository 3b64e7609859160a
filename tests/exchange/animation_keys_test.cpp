#include "exchange/animation_keys.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/math/linear_algebra.h"

namespace careen {
namespace {

Quat turned(const Vec3& axis, double angle) { return Quat(Eigen::AngleAxisd(angle, axis.normalized())); }

// What a player shows, worked out by Eigen.
Vec3 shown(const AnimationKeys<Vec3>& keys, double time) {
  std::size_t next = 1;
  while (next + 1 < keys.times.size() && keys.times[next] < time) {
    ++next;
  }
  const double from = keys.times[next - 1];
  const double part = (time - from) / (keys.times[next] - from);
  return keys.values[next - 1] + part * (keys.values[next] - keys.values[next - 1]);
}

TEST(AnimationKeys, areAsFewAsAParabolaNeeds) {
  const auto fall = [](double time) { return Vec3(3 * time, 0, 5 - 4.905 * time * time); };
  const AnimationKeys<Vec3> keys = positionKeys({.duration = 1, .kinks = {}, .seams = {}}, 1e-4, fall);
  // A chord of length h is off by g h²/8 in its middle: 111 steps of 9.03 ms at 9.81 m/s².
  EXPECT_GE(keys.times.size(), 112U);
  EXPECT_LE(keys.times.size(), 122U);  // measured: 117
  EXPECT_LE(keys.error, 1e-4);
  EXPECT_GT(keys.error, 0.8e-4);
  double worst = 0;
  for (int i = 0; i <= 10000; ++i) {
    worst = std::max(worst, (shown(keys, i / 10000.0) - fall(i / 10000.0)).norm());
  }
  EXPECT_LE(worst, 1e-4);
}

TEST(AnimationKeys, areTwoOfABodyAtRestAndTwoAtEachKink) {
  const auto still = [](double) { return Vec3(1, 2, 3); };
  const AnimationKeys<Vec3> rest = positionKeys({.duration = 7, .kinks = {}, .seams = {}}, 1e-4, still);
  EXPECT_EQ(rest.times.size(), 2U);
  EXPECT_TRUE(rest.isConstant());
  // 0.3 is no number of single precision: the keys are its neighbours, not the nearest.
  const auto bounce = [](double time) { return Vec3(std::abs(time - 0.3), 0, 0); };
  const AnimationKeys<Vec3> keys = positionKeys({.duration = 1, .kinks = {0.3}, .seams = {}}, 1e-4, bounce);
  ASSERT_EQ(keys.times.size(), 4U);
  EXPECT_LT(keys.times[1], 0.3);
  EXPECT_GT(keys.times[2], 0.3);
  EXPECT_EQ(std::nextafter(keys.times[1], 1.0F), keys.times[2]);
  EXPECT_LT(keys.error, 1e-7);
}

TEST(AnimationKeys, findAJumpThatNobodyAnnounced) {
  const auto jump = [](double time) { return Vec3(time < 0.4321 ? 0 : 1, 0, 0); };
  const AnimationKeys<Vec3> keys = positionKeys({.duration = 1, .kinks = {}, .seams = {}}, 1e-4, jump);
  EXPECT_LT(keys.times.size(), 15U);  // measured: 10
  EXPECT_EQ(shown(keys, 0.432).x(), 0);
  EXPECT_EQ(shown(keys, 0.4322).x(), 1);
}

TEST(AnimationKeys, ofAttitudesNeverTurnTheLongWay) {
  const Vec3 axis(1, 2, -2);
  const auto spin = [&](double time) { return turned(axis, 40 * time); };  // six turns
  const AnimationKeys<Quat> keys = rotationKeys({.duration = 1, .kinks = {}, .seams = {}}, 1e-4, spin);
  EXPECT_LE(keys.error, 1e-4);
  double worst = 0;
  for (std::size_t i = 1; i < keys.times.size(); ++i) {
    ASSERT_GT(keys.values[i - 1].dot(keys.values[i]), 0);
    for (const double part : {0.2, 0.21, 0.5, 0.79}) {
      const double time = keys.times[i - 1] + part * (keys.times[i] - keys.times[i - 1]);
      worst = std::max(worst, keys.values[i - 1].slerp(part, keys.values[i]).angularDistance(spin(time)));
      Quat blended;
      blended.coeffs() = (1 - part) * keys.values[i - 1].coeffs() + part * keys.values[i].coeffs();
      worst = std::max(worst, blended.normalized().angularDistance(spin(time)));
    }
  }
  EXPECT_LE(worst, 1.01e-4);
  EXPECT_GT(worst, 0.5e-4);  // measured: 0.96e-4, of normalised linear interpolation
}

TEST(AnimationKeys, ofALineHoldBothItsEnds) {
  const auto from = [](double time) { return Vec3(std::cos(3 * time), std::sin(3 * time), 0); };
  const auto to = [](double time) { return Vec3(0, -2, 1 - 5 * time * time); };
  const AnimationKeys<LinePlacement> keys =
      lineKeys({.duration = 1, .kinks = {}, .seams = {}}, 1e-4,
               [&](double time) { return linePlacement(from(time), to(time)); });
  EXPECT_LE(keys.error, 1e-4);
  for (std::size_t i = 0; i < keys.times.size(); ++i) {
    EXPECT_LT((keys.values[i].from - from(keys.times[i])).norm(), 1e-6);
    EXPECT_LT((keys.values[i].to() - to(keys.times[i])).norm(), 1e-6);
  }
  EXPECT_GT(keys.times.size(), 50U);
}

TEST(AnimationKeys, boundThatRoundingAloneExceedsIsRefused) {
  for (const double far : {1e6, 1e60}) {
    EXPECT_THROW(positionKeys({.duration = 1, .kinks = {}, .seams = {}}, 1e-4,
                              [far](double time) { return Vec3(far + time / 3, 0, 0); }),
                 InputError);
  }
  EXPECT_LT(positionKeys({.duration = 1, .kinks = {}, .seams = {}}, 0.1,
                         [](double time) { return Vec3(1e6 + time / 3, 0, 0); })
                .times.size(),
            5U);
}

TEST(LinePlacement, reachesEveryDirection) {
  for (const Vec3& way : {Vec3(0, 0, 1), Vec3(0, 0, -2), Vec3(1e-9, 0, -1), Vec3(3, -4, 0), Vec3(0, 0, 0)}) {
    const LinePlacement line = linePlacement(Vec3(1, 1, 1), Vec3(1, 1, 1) + way);
    EXPECT_LT((line.to() - Vec3(1, 1, 1) - way).norm(), 1e-8) << way.transpose();
  }
}

}  // namespace
}  // namespace careen
