#include "scene/solid_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "support/input_error.h"
#include "support/meshes.h"

namespace careen {
namespace {

double largest(const Mat3& matrix) { return matrix.cwiseAbs().maxCoeff(); }

// The corner of a cube: V = 1/6, centre (1/4, 1/4, 1/4); about the origin ∫x² = 1/60 and ∫xy = 1/120, about
// the centre 1/60 − 1/96 = 1/160 and 1/120 − 1/96 = −1/480.
TEST(SolidMesh, ofATetrahedronHasTheMomentsOfTheClosedForm) {
  const SolidMoments moments = momentsOf(tetrahedron());
  EXPECT_NEAR(moments.volume, 1. / 6, 1e-16);
  EXPECT_LT((moments.center - Vec3::Constant(0.25)).norm(), 1e-16);
  Mat3 expected = Mat3::Constant(1. / 480);
  expected.diagonal().setConstant(2. / 160);
  EXPECT_LT(largest(moments.inertia - expected), 1e-17);
}

TEST(SolidMesh, ofABoxHasTheMomentsOfASolidBox) {
  const Vec3 half(0.3, 0.2, 0.1);
  const SolidMoments moments = momentsOf(boxMesh(half, Vec3(5, -7, 3)));
  const double volume = 8 * half.prod();
  EXPECT_NEAR(moments.volume, volume, 1e-15);
  EXPECT_LT((moments.center - Vec3(5, -7, 3)).norm(), 1e-14);
  const Vec3 squares = half.cwiseAbs2();
  const Vec3 expected =
      volume / 3 * Vec3(squares.y() + squares.z(), squares.x() + squares.z(), squares.x() + squares.y());
  EXPECT_LT(largest(moments.inertia - Mat3(expected.asDiagonal())), 1e-15);
}

// I = A Ī Aᵀ, wherever it is.
TEST(SolidMesh, turnsWithItsMesh) {
  const SolidMoments moments = momentsOf(boxMesh(Vec3(0.3, 0.2, 0.1), Vec3::Zero()));
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  TriangleMesh turned = boxMesh(Vec3(0.3, 0.2, 0.1), Vec3::Zero());
  for (Vec3& point : turned.points) {
    point = turn * point + Vec3(1, 2, 3);
  }
  const SolidMoments others = momentsOf(turned);
  EXPECT_LT((others.center - Vec3(1, 2, 3)).norm(), 1e-14);
  EXPECT_LT(largest(others.inertia - turn * moments.inertia * turn.transpose()), 1e-15);
}

// A cavity is a mesh within that faces inward: moments subtract.
TEST(SolidMesh, takesCavitiesOut) {
  TriangleMesh hollow = boxMesh(Vec3::Constant(1), Vec3::Zero());
  append(hollow, insideOut(boxMesh(Vec3::Constant(0.5), Vec3(0.25, 0, 0))));
  const SolidMoments moments = momentsOf(hollow);
  EXPECT_NEAR(moments.volume, 7, 1e-14);
  EXPECT_LT((moments.center - Vec3(-0.25 / 7, 0, 0)).norm(), 1e-15);
  // Iₓ: 8·2/3 − 1·0.5/3; I_y with the two shifts of the centre.
  EXPECT_NEAR(moments.inertia(0, 0), 16. / 3 - 1. / 6, 1e-14);
  EXPECT_NEAR(moments.inertia(1, 1), 16. / 3 - 1. / 6 - 0.0625 - 7 * (0.25 / 7) * (0.25 / 7), 1e-14);
}

// Inscribed meshes of n² faces approach the smooth body with the square of the edge: a quarter at each
// halving.
TEST(SolidMesh, convergesToTorusAndSphere) {
  const double pi = std::numbers::pi;
  const double volume = 2 * pi * pi * 1 * 0.09;         // 2π²Rr²
  const double axial = volume * (1 + 0.75 * 0.09);      // M(R² + 3r²/4)
  const double across = volume * (0.5 + 0.625 * 0.09);  // M(R²/2 + 5r²/8)
  double before = 0;
  for (const int count : {16, 32, 64, 128}) {
    const SolidMoments moments = momentsOf(torusMesh(1, 0.3, count));
    const double error = std::fabs(moments.inertia(2, 2) / axial - 1);
    EXPECT_LT(std::fabs(moments.volume / volume - 1), 20. / (count * count));
    EXPECT_LT(std::fabs(moments.inertia(0, 0) / across - 1), 30. / (count * count));
    EXPECT_LT(moments.center.norm(), 1e-14);
    if (before > 0) {
      EXPECT_NEAR(before / error, 4, 0.15) << count;
    }
    before = error;
  }
  before = 0;
  for (const int count : {4, 8, 16, 32}) {
    const SolidMoments moments = momentsOf(sphereMesh(2, count));
    const double error = std::fabs(moments.inertia(0, 0) / (4. / 3 * pi * 8 * 0.4 * 4) - 1);  // 2/5 M R²
    if (before > 0) {
      EXPECT_NEAR(before / error, 4, 0.4) << count;
    }
    before = error;
  }
  EXPECT_LT(before, 0.01);
}

TEST(SolidMesh, thatIsOpenIsRefusedWithTheEdge) {
  TriangleMesh open = boxMesh(Vec3(1, 2, 3), Vec3::Zero());
  open.triangles.pop_back();
  const std::string message = inputErrorOf([&] { momentsOf(open); });
  EXPECT_TRUE(message.starts_with("found the edge from (")) << message;
  EXPECT_TRUE(message.ends_with(" of one face alone, expected a closed mesh")) << message;
}

TEST(SolidMesh, withAFaceTurnedOverIsRefusedWithTheEdge) {
  TriangleMesh mesh = tetrahedron();
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  const std::string message = inputErrorOf([&] { momentsOf(mesh); });
  EXPECT_TRUE(message.starts_with("found two faces that run along the edge from (")) << message;
  EXPECT_NE(message.find("a face is turned over, or more than two meet there"), std::string::npos);
}

TEST(SolidMesh, insideOutOrOfNothingIsRefused) {
  EXPECT_TRUE(inputErrorOf([] {
                momentsOf(insideOut(tetrahedron()));
              }).starts_with("found a mesh inside out, of volume -0.1667 m³"));
  TriangleMesh flat = tetrahedron();
  flat.points[3].z() = 0;
  EXPECT_TRUE(inputErrorOf([&] { momentsOf(flat); }).starts_with("found a mesh that encloses nothing"));
  EXPECT_TRUE(inputErrorOf([] { momentsOf({}); }).starts_with("found no faces"));
}

}  // namespace
}  // namespace careen
