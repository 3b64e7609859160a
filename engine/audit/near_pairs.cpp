#include "audit/near_pairs.h"

#include <algorithm>
#include <cmath>

namespace careen {
namespace {

int widestAxis(std::span<const Ball> balls) {
  Vec3 sum = Vec3::Zero();
  Vec3 squares = Vec3::Zero();
  for (const Ball& ball : balls) {
    if (ball.center.allFinite()) {
      sum += ball.center;
      squares += ball.center.cwiseAbs2();
    }
  }
  const Vec3 spread = squares - sum.cwiseAbs2() / std::max(1.0, static_cast<double>(balls.size()));
  int axis = 0;
  spread.maxCoeff(&axis);
  return axis;
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> nearPairs(std::span<const Ball> balls) {
  const int axis = widestAxis(balls);
  const auto low = [&](std::size_t i) { return balls[i].center[axis] - balls[i].radius; };
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    if (balls[i].center.allFinite()) {
      order.push_back(i);
    }
  }
  std::sort(order.begin(), order.end(), [&](std::size_t x, std::size_t y) { return low(x) < low(y); });
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t first = 0; first < order.size(); ++first) {
    const Ball& a = balls[order[first]];
    const double end = a.center[axis] + a.radius;
    for (std::size_t second = first + 1; second < order.size() && low(order[second]) <= end; ++second) {
      const Ball& b = balls[order[second]];
      const double reach = a.radius + b.radius;
      if ((a.center - b.center).squaredNorm() <= reach * reach) {
        pairs.emplace_back(std::minmax(order[first], order[second]));
      }
    }
  }
  return pairs;
}

}  // namespace careen
