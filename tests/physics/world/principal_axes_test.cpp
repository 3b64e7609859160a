#include "physics/world/principal_axes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "physics/world/given_inertia.h"
#include "support/impact_scene.h"

namespace careen {
namespace {

Mat3 tensorOf(const PrincipalAxes& found) {
  return found.axes * found.moments.asDiagonal() * found.axes.transpose();
}

// Ten thousand tensors of moments up to 1e12 apart, known by how they are made.
TEST(PrincipalAxes, areThoseThatTheTensorWasMadeOf) {
  test::Random random(1);
  double residual = 0;
  double moment = 0;
  double rotation = 0;
  for (int trial = 0; trial < 10'000; ++trial) {
    const double spread = trial % 3 == 0 ? 12 : 1;
    Vec3 moments;
    for (double& each : moments) {
      each = std::pow(10, random.between(-spread, 0));
    }
    if (trial % 5 == 0) {
      moments.y() = moments.x();
    }
    const Mat3 axes = random.rotation();
    Mat3 tensor = axes * moments.asDiagonal() * axes.transpose();
    tensor = (0.5 * (tensor + tensor.transpose())).eval();
    const PrincipalAxes found = principalAxes(tensor);
    const double size = moments.maxCoeff();
    residual = std::max(residual, (tensorOf(found) - tensor).norm() / size);
    rotation = std::max({rotation, (found.axes * found.axes.transpose() - Mat3::Identity()).norm(),
                         std::fabs(found.axes.determinant() - 1)});
    Vec3 expected = moments;
    Vec3 sorted = found.moments;
    std::sort(expected.begin(), expected.end());
    std::sort(sorted.begin(), sorted.end());
    moment = std::max(moment, (sorted - expected).norm() / size);
  }
  EXPECT_LT(residual, 4e-15);
  EXPECT_LT(moment, 4e-15);
  EXPECT_LT(rotation, 1e-15);
}

// [[2, 1], [1, 2]] has the moments 1 and 3 along the diagonals.
TEST(PrincipalAxes, ofAKnownTensor) {
  Mat3 tensor;
  tensor << 2, 1, 0, 1, 2, 0, 0, 0, 2.5;
  const PrincipalAxes found = principalAxes(tensor);
  EXPECT_LT((found.moments - Vec3(1, 3, 2.5)).norm(), 1e-15);
  EXPECT_LT((found.axes.col(0) - Vec3(1, -1, 0).normalized()).norm(), 1e-15);
  EXPECT_LT((found.axes.col(2) - Vec3::UnitZ()).norm(), 1e-15);
}

TEST(PrincipalAxes, ofADiagonalTensorAreItsOwnToTheBit) {
  const PrincipalAxes found = principalAxes(Vec3(3, 1, 2).asDiagonal());
  EXPECT_EQ(found.moments, Vec3(3, 1, 2));
  EXPECT_EQ(found.axes, Mat3(Mat3::Identity()));
}

TEST(PrincipalAxes, makeABodyWhoseInertiaIsTheTensor) {
  test::Random random(2);
  for (int trial = 0; trial < 1000; ++trial) {
    const Vec3 half(random.between(0.1, 1), random.between(0.1, 1), random.between(0.1, 1));
    const Mat3 axes = random.rotation();
    Mat3 tensor = axes * solidBox(half, 3).inertiaBody.asDiagonal() * axes.transpose();
    tensor = (0.5 * (tensor + tensor.transpose())).eval();
    const MassProperties mass = massWithTensor(3, tensor);
    const Vec3 v = random.inCube(1);
    EXPECT_TRUE(mass.turned);
    EXPECT_LT((mass.inertiaTensor() - tensor).norm(), 1e-14 * tensor.norm());
    EXPECT_LT((mass.inertiaTimes(v) - tensor * v).norm(), 1e-14 * tensor.norm());
    EXPECT_LT((tensor * mass.inverseInertiaTimes(v) - v).norm(), 1e-12);
  }
  EXPECT_EQ(massWithTensor(2, solidBox({1, 2, 3}, 2).inertiaBody.asDiagonal()), solidBox({1, 2, 3}, 2));
}

}  // namespace
}  // namespace careen
