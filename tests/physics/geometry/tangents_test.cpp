#include "physics/geometry/tangents.h"

#include <gtest/gtest.h>

#include <random>

namespace careen {
namespace {

Vec3 someNormal(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return Vec3(normal(random), normal(random), normal(random)).normalized();
}

TEST(Tangents, completeTheNormalToARightHandedFrame) {
  std::mt19937_64 random(7);
  for (int k = 0; k < 10'000; ++k) {
    const Vec3 normal = k < 3 ? Vec3(Vec3::Unit(k)) : someNormal(random);
    const Tangents tangents = tangentsOf(normal);
    Mat3 frame;
    frame << normal, tangents.first, tangents.second;
    // measured 5.6e-16
    EXPECT_LT((frame.transpose() * frame - Mat3::Identity()).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_GT(frame.determinant(), 0);
  }
}

// A mirror at a coordinate plane changes the sign of one component: up to their signs the tangents do the
// same.
TEST(Tangents, areMirroredWithTheNormalToTheBit) {
  std::mt19937_64 random(8);
  for (int k = 0; k < 1000; ++k) {
    const Vec3 normal = someNormal(random);
    const Tangents tangents = tangentsOf(normal);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      Vec3 mirror = Vec3::Ones();
      mirror[axis] = -1;
      const Tangents mirrored = tangentsOf(normal.cwiseProduct(mirror));
      EXPECT_EQ(mirrored.first.cwiseAbs(), tangents.first.cwiseAbs());
      EXPECT_EQ(mirrored.second.cwiseAbs(), tangents.second.cwiseAbs());
      const Vec3 first = tangents.first.cwiseProduct(mirror);
      EXPECT_TRUE(mirrored.first == first || mirrored.first == -first) << normal.transpose();
    }
  }
}

}  // namespace
}  // namespace careen
