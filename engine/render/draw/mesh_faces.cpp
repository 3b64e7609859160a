#include "render/draw/mesh_faces.h"

#include <cstddef>
#include <map>
#include <utility>

namespace careen {
namespace {

using Edge = std::pair<std::size_t, std::size_t>;

// The height of the corner opposite to an edge of a triangle this thin, relative to the edge, is not drawn.
constexpr double kThinnestTriangle = 1e-9;

}  // namespace

std::vector<MeshFace> meshFacesTowards(const TriangleMesh& mesh, const Pose& pose, const Vec3& eye) {
  const Vec3 from = pose.worldFromBody.transpose() * (eye - pose.position);  // the mesh's frame
  std::vector<Vec3> normals;
  std::vector<bool> faces;
  std::map<Edge, std::size_t> owner;  // of an edge in the direction in which the triangle runs along it
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 across = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
    const double size = across.norm();
    normals.emplace_back(size > 0 ? Vec3(across / size) : Vec3(Vec3::Zero()));
    faces.push_back(size > 0 && normals.back().dot(from - mesh.points[a]) > 0);
    owner[{a, b}] = owner[{b, c}] = owner[{c, a}] = t;
  }
  std::vector<MeshFace> result;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!faces[t]) {
      continue;
    }
    const auto& triangle = mesh.triangles[t];
    std::array<std::size_t, 3> order{0, 1, 2};  // edge k runs from corner k: those of the silhouette first
    std::size_t found = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto beyond = owner.find({triangle.at((k + 1) % 3), triangle.at(k)});
      if (beyond == owner.end() || !faces[beyond->second]) {
        std::swap(order.at(found++), order.at(k));
      }
    }
    MeshFace face;
    for (std::size_t k = 0; k < 3; ++k) {
      face.corners.at(k) = pose.worldPoint(mesh.points[triangle.at(k)]);
    }
    face.normal = pose.worldFromBody * normals[t];
    bool thin = false;
    for (std::size_t side = 0; side < 2; ++side) {
      const std::size_t k = order.at(side);
      const Vec3& start = face.corners.at(k);
      const Vec3 along = face.corners.at((k + 1) % 3) - start;
      const Vec3& opposite = face.corners.at((k + 2) % 3);
      const Vec3 outward = along.cross(face.normal).normalized();
      const double height = outward.dot(start - opposite);
      thin = thin || !(height > kThinnestTriangle * along.norm());
      face.outward.at(side) = outward;
      face.height.at(side) = height;
      for (std::size_t corner = 0; corner < 3; ++corner) {
        face.place.at(corner).at(side) = corner == (k + 2) % 3 ? 0 : height;
      }
    }
    if (!thin) {
      result.push_back(face);
    }
  }
  return result;
}

}  // namespace careen
