#include "scene/solid_mesh.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/brief.h"
#include "core/error.h"

namespace careen {
namespace {

using Edge = std::pair<std::size_t, std::size_t>;  // from, to

std::string placeOf(const TriangleMesh& mesh, std::size_t point) {
  const Vec3& at = mesh.points[point];
  return "(" + brief(at.x(), 6) + ", " + brief(at.y(), 6) + ", " + brief(at.z(), 6) + ")";
}

std::string describe(const TriangleMesh& mesh, const Edge& edge) {
  return "the edge from " + placeOf(mesh, edge.first) + " to " + placeOf(mesh, edge.second);
}

// Every edge must be run along once in each direction.
void checkEdges(const TriangleMesh& mesh) {
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const std::array<std::size_t, 3>& triangle : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      edges.emplace_back(triangle.at(k), triangle.at((k + 1) % 3));
    }
  }
  std::sort(edges.begin(), edges.end());
  const auto twice = std::adjacent_find(edges.begin(), edges.end());
  if (twice != edges.end()) {
    throw InputError("found two faces that run along " + describe(mesh, *twice) +
                     " in the same direction, expected one in each: a face is turned over, or more than two "
                     "meet there");
  }
  for (const Edge& edge : edges) {
    if (!std::binary_search(edges.begin(), edges.end(), Edge(edge.second, edge.first))) {
      throw InputError("found " + describe(mesh, edge) + " of one face alone, expected a closed mesh");
    }
  }
}

Vec3 middleOf(const TriangleMesh& mesh) {
  Vec3 least = mesh.points.front();
  Vec3 most = least;
  for (const Vec3& point : mesh.points) {
    least = least.cwiseMin(point);
    most = most.cwiseMax(point);
  }
  return 0.5 * least + 0.5 * most;
}

}  // namespace

void SolidSums::add(const Vec3& fromA, const Vec3& fromB, const Vec3& fromC) {
  const Vec3 a = fromA - from_;
  const Vec3 b = fromB - from_;
  const Vec3 c = fromC - from_;
  const Vec3 sum = a + b + c;
  const double determinant = dot(a, b.cross(c));
  volume_ += determinant / 6;
  size_ += std::fabs(determinant) / 6;
  first_ += determinant / 24 * sum;
  second_ +=
      determinant / 120 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
}

SolidMoments SolidSums::moments() const {
  const Vec3 off = first_ / volume_;
  SolidMoments moments{.volume = volume_, .center = from_ + off};
  const Mat3 spread = second_ - volume_ * (off * off.transpose());
  moments.inertia = spread.trace() * Mat3::Identity() - spread;
  return moments;
}

SolidMoments momentsOf(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) {
    throw InputError("found no faces, expected a closed mesh");
  }
  checkEdges(mesh);
  SolidSums sums(middleOf(mesh));  // near all of it, so that little cancels
  for (const auto& [i, j, k] : mesh.triangles) {
    sums.add(mesh.points[i], mesh.points[j], mesh.points[k]);
  }
  constexpr double kNothing = 1e-12;  // of the tetrahedra: rounding
  if (!(std::fabs(sums.volume()) > kNothing * sums.size())) {
    throw InputError("found a mesh that encloses nothing, expected a closed mesh around a volume");
  }
  if (sums.volume() < 0) {
    throw InputError("found a mesh inside out, of volume " + brief(sums.volume()) +
                     " m³, expected faces that run anticlockwise when seen from outside");
  }
  return sums.moments();
}

}  // namespace careen
