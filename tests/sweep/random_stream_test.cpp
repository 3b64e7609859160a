#include "sweep/random_stream.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

namespace careen {
namespace {

constexpr int kDraws = 100'000;

TEST(RandomStream, dependsOnSeedRunAndAttemptAlone) {
  std::set<std::uint64_t> first;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    for (std::uint64_t run = 0; run < 100; ++run) {
      for (std::uint64_t attempt = 0; attempt < 10; ++attempt) {
        first.insert(RandomStream(seed, run, attempt).bits());
        EXPECT_EQ(RandomStream(seed, run, attempt).bits(), RandomStream(seed, run, attempt).bits());
      }
    }
  }
  EXPECT_EQ(first.size(), 10'000U);
  // The same on every machine.
  EXPECT_EQ(RandomStream(1, 2, 3).bits(), 3811353409544149516U);
  EXPECT_EQ(RandomStream(1, 2, 3).normal(), 0x1.62f84fbea55eep-4);
}

TEST(RandomStream, hasTheMomentsOfItsDistributions) {
  RandomStream random(1, 0, 0);
  double mean = 0;
  double square = 0;
  double fourth = 0;
  double unit = 0;
  std::array<int, 6> faces{};
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.normal();
    mean += x / kDraws;
    square += x * x / kDraws;
    fourth += x * x * x * x / kDraws;
    unit += random.uniform(2, 4) / kDraws;
    ++faces.at(static_cast<std::size_t>(random.integer(1, 6) - 1));
  }
  EXPECT_NEAR(mean, 0, 0.015);  // standard error 0.003
  EXPECT_NEAR(square, 1, 0.025);
  EXPECT_NEAR(fourth, 3, 0.2);
  EXPECT_NEAR(unit, 3, 0.01);
  for (const int count : faces) {
    EXPECT_NEAR(count, kDraws / 6.0, 600);  // standard deviation 118
  }
}

TEST(RandomStream, directionsAndRotationsAreUniform) {
  RandomStream random(5, 0, 0);
  Mat3 ofDirections = Mat3::Zero();
  Mat3 ofRotations = Mat3::Zero();
  double angle = 0;
  for (int i = 0; i < kDraws; ++i) {
    const Vec3 direction = random.direction();
    ASSERT_NEAR(direction.norm(), 1, 1e-14);
    ofDirections += direction * direction.transpose() / kDraws;
    const Quat turn = random.rotation();
    ASSERT_NEAR(turn.norm(), 1, 1e-14);
    const Vec3 turned = turn * Vec3(0, 0, 1);
    ofRotations += turned * turned.transpose() / kDraws;
    angle += 2 * std::acos(std::min(1.0, std::abs(turn.w()))) / kDraws;
  }
  EXPECT_LT((ofDirections - Mat3(Mat3::Identity() / 3)).norm(), 0.01);
  EXPECT_LT((ofRotations - Mat3(Mat3::Identity() / 3)).norm(), 0.01);
  EXPECT_NEAR(angle, M_PI / 2 + 2 / M_PI, 0.01);  // mean angle of a uniform rotation
}

}  // namespace
}  // namespace careen
