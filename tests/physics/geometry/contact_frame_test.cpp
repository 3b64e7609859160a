#include "physics/geometry/contact_frame.h"

#include <gtest/gtest.h>

#include <random>

namespace careen {
namespace {

Vec3 someNormal(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return Vec3(normal(random), normal(random), normal(random)).normalized();
}

TEST(ContactFrame, completeTheNormalToARightHandedFrame) {
  std::mt19937_64 random(7);
  for (int k = 0; k < 10'000; ++k) {
    const Vec3 normal = k < 3 ? Vec3(Vec3::Unit(k)) : someNormal(random);
    const ContactFrame frame = frameOf(normal);
    Mat3 axes;
    axes << frame.normal, frame.tangent1, frame.tangent2;
    // measured 5.6e-16
    EXPECT_LT((axes.transpose() * axes - Mat3::Identity()).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_GT(axes.determinant(), 0);
  }
}

TEST(ContactFrame, takesPartsAndPutsThemTogether) {
  const ContactFrame frame = frameOf(Vec3(0.48, 0.6, 0.64));
  const Vec3 v(1, -2, 3);
  const ContactFrame::Triple parts = frame.along(v);
  EXPECT_NEAR(parts[0], 0.48 - 1.2 + 1.92, 1e-15);
  EXPECT_LT((frame.inWorld(parts) - v).norm(), 2e-15);
  EXPECT_EQ(frame.inWorld({0, 2, -3}), frame.across(2, -3));
  EXPECT_NEAR(frame.across(3, 4).norm(), 5, 1e-15);
  EXPECT_EQ(frame.axes()[1], frame.tangent1);
}

// A mirror at a coordinate plane changes the sign of one component: up to their signs the tangents do the
// same.
TEST(ContactFrame, areMirroredWithTheNormalToTheBit) {
  std::mt19937_64 random(8);
  for (int k = 0; k < 1000; ++k) {
    const Vec3 normal = someNormal(random);
    const ContactFrame frame = frameOf(normal);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      Vec3 mirror = Vec3::Ones();
      mirror[axis] = -1;
      const ContactFrame mirrored = frameOf(normal.cwiseProduct(mirror));
      EXPECT_EQ(mirrored.tangent1.cwiseAbs(), frame.tangent1.cwiseAbs());
      EXPECT_EQ(mirrored.tangent2.cwiseAbs(), frame.tangent2.cwiseAbs());
      const Vec3 first = frame.tangent1.cwiseProduct(mirror);
      EXPECT_TRUE(mirrored.tangent1 == first || mirrored.tangent1 == -first) << normal.transpose();
    }
  }
}

}  // namespace
}  // namespace careen
