#include "audit/near_pairs.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>

namespace careen {
namespace {

TEST(NearPairs, areThoseOfTestingEachWithEach) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> place(-1, 1);
  std::vector<Ball> balls;
  for (int i = 0; i < 200; ++i) {
    balls.push_back(
        {Vec3(place(engine), 3 * place(engine), place(engine)), 0.05 + 0.1 * std::abs(place(engine))});
  }
  std::set<std::pair<std::size_t, std::size_t>> expected;
  for (std::size_t a = 0; a < balls.size(); ++a) {
    for (std::size_t b = a + 1; b < balls.size(); ++b) {
      if ((balls[a].center - balls[b].center).norm() <= balls[a].radius + balls[b].radius) {
        expected.insert({a, b});
      }
    }
  }
  const auto found = nearPairs(balls);
  EXPECT_GT(expected.size(), 20U);
  EXPECT_EQ(found.size(), expected.size());
  EXPECT_EQ((std::set<std::pair<std::size_t, std::size_t>>(found.begin(), found.end())), expected);
}

TEST(NearPairs, leaveOutWhatIsNowhere) {
  std::vector<Ball> balls(3, {Vec3::Zero(), 1});
  balls[1].center.x() = std::numeric_limits<double>::quiet_NaN();
  const auto found = nearPairs(balls);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0], (std::pair<std::size_t, std::size_t>(0, 2)));
}

}  // namespace
}  // namespace careen
