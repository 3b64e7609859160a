#include "stage/turn.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/math/rotation.h"
#include "support/article_equations.h"

namespace careen {
namespace {

TEST(Turn, isExactAtQuarters) {
  for (const double whole : {0.0, 360.0, -360.0, 3600000.0}) {
    EXPECT_EQ(turnFrom(whole).cosine, 1);
    EXPECT_EQ(turnFrom(whole).sine, 0);
    EXPECT_EQ(turnFrom(whole + 90).cosine, 0);
    EXPECT_EQ(turnFrom(whole + 90).sine, 1);
    EXPECT_EQ(turnFrom(whole + 180).cosine, -1);
    EXPECT_EQ(turnFrom(whole + 180).sine, 0);
    EXPECT_EQ(turnFrom(whole - 90).cosine, 0);
    EXPECT_EQ(turnFrom(whole - 90).sine, -1);
  }
}

TEST(Turn, agreesWithTheLibraryInLongDouble) {
  double worst = 0;
  for (int i = -72'000; i <= 72'000; ++i) {
    const double degrees = i * 0.01;
    const long double angle = static_cast<long double>(degrees) * std::numbers::pi_v<long double> / 180;
    const Turn turn = turnFrom(degrees);
    worst = std::max({worst, static_cast<double>(std::fabs(turn.cosine - std::cos(angle))),
                      static_cast<double>(std::fabs(turn.sine - std::sin(angle)))});
  }
  EXPECT_LT(worst, 2.3e-16);  // measured 1.5e-16
}

TEST(Turn, rotatesByTheRightHandRule) {
  const Vec3 turned = rotationAbout(Vec3::UnitZ(), turnFrom(90)) * Vec3::UnitX();
  EXPECT_EQ(turned, Vec3::UnitY());
  const Vec3 axis = Vec3(1, -2, 3).normalized();
  const Mat3 rotation = rotationAbout(axis, turnFrom(40));
  EXPECT_LT(orthogonalityError(rotation), 1e-15);                                      // measured 2.3e-16
  EXPECT_LT((rotation - axisAngle(axis, 40 * std::numbers::pi / 180)).norm(), 1e-15);  // measured 2.8e-16
}

// Without end, not without sense: what a full turn leaves over.
TEST(Turn, hugeAnglesStayFinite) {
  const Turn turn = turnFrom(1e60);
  EXPECT_NEAR(turn.cosine * turn.cosine + turn.sine * turn.sine, 1, 1e-15);
}

}  // namespace
}  // namespace careen
