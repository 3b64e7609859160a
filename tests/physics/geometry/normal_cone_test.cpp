#include "physics/geometry/normal_cone.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/tumbling_box.h"

namespace careen {
namespace {

using test::Dice;
using test::turned;

NormalCone::Centre centreOf(const std::vector<Vec3>& bounds) {
  NormalCone cone;
  for (const Vec3& bound : bounds) {
    cone.add(bound);
  }
  return cone.centre();
}

double marginOf(const Vec3& direction, const std::vector<Vec3>& bounds) {
  double least = 1;
  for (const Vec3& bound : bounds) {
    least = std::min(least, direction.dot(bound));
  }
  return least;
}

// The axes of two boxes that meet corner to corner along n, each pointing into its half.
std::vector<Vec3> cornerOnCorner(Dice& dice, const Vec3& n) {
  std::vector<Vec3> bounds;
  for (int box = 0; box < 2; ++box) {
    const Mat3 axes = dice.orientation();
    for (int i = 0; i < 3; ++i) {
      bounds.push_back(axes.col(i).dot(n) < 0 ? Vec3(-axes.col(i)) : Vec3(axes.col(i)));
    }
  }
  return bounds;
}

TEST(NormalCone, ofAnOctantIsItsDiagonal) {
  const NormalCone::Centre centre = centreOf({Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()});
  EXPECT_NEAR((centre.direction - Vec3::Ones().normalized()).norm(), 0, 1e-15);
  EXPECT_NEAR(centre.margin, std::sqrt(1.0 / 3), 1e-15);
}

// One turned about the common diagonal by any angle leaves it the centre, of a smaller cone.
TEST(NormalCone, ofTwoOctantsAboutOneDiagonalIsTheDiagonal) {
  const Vec3 diagonal = Vec3::Ones().normalized();
  for (int k = 0; k <= 24; ++k) {
    const Mat3 turn = turned<double>(diagonal, k * std::acos(-1.0) / 12);
    const NormalCone::Centre centre =
        centreOf({Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), turn.col(0), turn.col(1), turn.col(2)});
    EXPECT_NEAR((centre.direction - diagonal).norm(), 0, 1e-15) << k;
  }
}

// Right-angled fans from α and from β > α, in one plane, share β to α + 90°: the bisector is at (α+β)/2 +
// 45°.
TEST(NormalCone, ofTwoFansIsTheBisectorOfWhatTheyShare) {
  Dice dice(3);
  for (int k = 0; k < 1000; ++k) {
    const Mat3 frame = dice.orientation();
    const double alpha = dice.between(-3, 3);
    const double beta = alpha + dice.between(1e-6, 1.57);
    const auto at = [&](double angle) {
      return Vec3(std::cos(angle) * frame.col(0) + std::sin(angle) * frame.col(1));
    };
    const double right = std::acos(-1.0) / 2;
    const NormalCone::Centre centre = centreOf({at(alpha), at(alpha + right), at(beta), at(beta + right)});
    ASSERT_NEAR((centre.direction - at((alpha + beta + right) / 2)).norm(), 0, 1e-14) << k;
    ASSERT_NEAR(centre.margin, std::sin((alpha + right - beta) / 2), 1e-14) << k;
  }
}

// No other direction has a larger margin, neither far away nor beside it.
TEST(NormalCone, ofTwoCornersHasTheLargestMargin) {
  Dice dice(4);
  for (int k = 0; k < 1000; ++k) {
    const Vec3 n = dice.direction();
    const std::vector<Vec3> bounds = cornerOnCorner(dice, n);
    const NormalCone::Centre centre = centreOf(bounds);
    ASSERT_NEAR(centre.direction.norm(), 1, 1e-15);
    ASSERT_NEAR(marginOf(centre.direction, bounds), centre.margin, 1e-15);
    ASSERT_GE(centre.margin, marginOf(n, bounds));
    for (int other = 0; other < 100; ++other) {
      const double beside = std::exp(dice.between(-30, 1));
      const Vec3 tried = (centre.direction + beside * dice.direction()).normalized();
      ASSERT_LE(marginOf(tried, bounds), centre.margin + 1e-15) << k << " " << beside;
    }
  }
}

TEST(NormalCone, isTheSameToTheBitMirroredTurnedAndInAnyOrder) {
  Dice dice(5);
  const auto turn = [](const Vec3& v) { return Vec3(-v.y(), v.z(), -v.x()); };
  for (int k = 0; k < 2000; ++k) {
    std::vector<Vec3> bounds = cornerOnCorner(dice, dice.direction());
    if (k % 2 == 0) {  // the other corner is the mirror image of the first
      const Vec3 mirror = dice.direction();
      for (std::size_t i = 0; i < 3; ++i) {
        bounds[i] = bounds[i].dot(mirror) < 0 ? Vec3(-bounds[i]) : bounds[i];
        bounds[3 + i] = 2 * bounds[i].dot(mirror) * mirror - bounds[i];
      }
    }
    const Vec3 centre = centreOf(bounds).direction;
    std::vector<Vec3> other(bounds.rbegin(), bounds.rend());
    std::swap(other[1], other[4]);
    ASSERT_EQ(centreOf(other).direction, centre) << k;
    std::transform(bounds.begin(), bounds.end(), other.begin(), turn);
    ASSERT_EQ(centreOf(other).direction, turn(centre)) << k;
  }
}

}  // namespace
}  // namespace careen
