#include "render/draw/mesh_faces.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/meshes.h"

namespace careen {
namespace {

double areaOf(const MeshFace& face) {
  return 0.5 * (face.corners[1] - face.corners[0]).cross(face.corners[2] - face.corners[0]).norm();
}

TEST(MeshFaces, areThoseOfTheSidesThatABoxShows) {
  const TriangleMesh mesh = boxMesh(Vec3(0.3, 0.2, 0.1), Vec3::Zero());
  const Pose pose{.position = Vec3(1, 2, 3)};
  const std::vector<MeshFace> faces = meshFacesTowards(mesh, pose, Vec3(11, 12, 2.95));
  double area = 0;
  for (const MeshFace& face : faces) {
    area += areaOf(face);
    EXPECT_NEAR(face.normal.z(), 0, 1e-15);
  }
  EXPECT_EQ(faces.size(), 4U);
  EXPECT_NEAR(area, 0.4 * 0.2 + 0.6 * 0.2, 1e-15);
  EXPECT_EQ(meshFacesTowards(mesh, pose, Vec3(11, 12, 13)).size(), 6U);
}

// A point of the triangle lies as far inside an edge as the place of its corners says.
TEST(MeshFaces, placesTellTheDistanceFromTheSilhouette) {
  const TriangleMesh mesh = boxMesh(Vec3(0.3, 0.2, 0.1), Vec3::Zero());
  for (const MeshFace& face : meshFacesTowards(mesh, {}, Vec3(3, 5, 8))) {
    for (std::size_t side = 0; side < 2; ++side) {
      const Vec3 middle = (face.corners[0] + face.corners[1] + face.corners[2]) / 3;
      double place = 0;
      double furthest = -1;
      for (std::size_t k = 0; k < 3; ++k) {
        place += face.place[k][side] / 3;
        furthest = std::max(furthest, face.outward[side].dot(face.corners[k]));
      }
      EXPECT_NEAR(furthest - face.outward[side].dot(middle), face.height[side] - place, 1e-15);
      EXPECT_NEAR(face.outward[side].dot(face.normal), 0, 1e-15);
    }
    // The first edge belongs to the silhouette: beyond it lies a side turned away. Of a box each triangle has
    // one such edge, or its sides are seen on all edges but the diagonal.
    EXPECT_GT(face.height[0], 0);
  }
}

TEST(MeshFaces, withoutAreaAreNotDrawn) {
  TriangleMesh mesh{.points = {Vec3::Zero(), Vec3::UnitX(), 2 * Vec3::UnitX()}, .triangles = {{0, 1, 2}}};
  EXPECT_TRUE(meshFacesTowards(mesh, {}, Vec3(0, 0, 5)).empty());
}

}  // namespace
}  // namespace careen
