#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <sstream>
#include <string>

#include "scene/solid_mesh.h"

namespace careen {

/// The corner of the unit cube at the origin.
inline TriangleMesh tetrahedron() {
  return {.points = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()},
          .triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

inline TriangleMesh boxMesh(const Vec3& half, const Vec3& center) {
  TriangleMesh mesh;
  for (const double z : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      for (const double x : {-1.0, 1.0}) {
        mesh.points.emplace_back(center + half.cwiseProduct(Vec3(x, y, z)));
      }
    }
  }
  const std::array<std::array<std::size_t, 4>, 6> faces = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& [a, b, c, d] : faces) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
  return mesh;
}

inline TriangleMesh insideOut(TriangleMesh mesh) {
  for (auto& triangle : mesh.triangles) {
    std::swap(triangle[1], triangle[2]);
  }
  return mesh;
}

inline void append(TriangleMesh& mesh, const TriangleMesh& other) {
  const std::size_t first = mesh.points.size();
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  for (const auto& [a, b, c] : other.triangles) {
    mesh.triangles.push_back({first + a, first + b, first + c});
  }
}

/// About z, with `count` parts around the axis and around the tube.
inline TriangleMesh torusMesh(double radius, double tube, int count) {
  TriangleMesh mesh;
  const auto n = static_cast<std::size_t>(count);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const double u = 2 * std::numbers::pi * static_cast<double>(i) / count;
      const double v = 2 * std::numbers::pi * static_cast<double>(j) / count;
      const double out = radius + tube * std::cos(v);
      mesh.points.emplace_back(out * std::cos(u), out * std::sin(u), tube * std::sin(v));
      const auto at = [n](std::size_t row, std::size_t column) { return row % n * n + column % n; };
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

/// The faces of a cube in count² squares each, pushed out to the sphere.
inline TriangleMesh sphereMesh(double radius, int count) {
  TriangleMesh mesh;
  const TriangleMesh cube = boxMesh(Vec3::Constant(1), Vec3::Zero());
  const auto n = static_cast<std::size_t>(count);
  std::vector<std::array<long, 3>> keys;
  const auto pointAt = [&](const Vec3& on) {
    const std::array<long, 3> key = {std::lround(on.x() * count), std::lround(on.y() * count),
                                     std::lround(on.z() * count)};
    const auto known = std::find(keys.begin(), keys.end(), key);
    if (known != keys.end()) {
      return static_cast<std::size_t>(known - keys.begin());
    }
    keys.push_back(key);
    mesh.points.emplace_back(radius * on.normalized());
    return keys.size() - 1;
  };
  for (std::size_t face = 0; face < 12; face += 2) {
    const Vec3& a = cube.points[cube.triangles[face][0]];
    const Vec3 u = (cube.points[cube.triangles[face][1]] - a) / count;
    const Vec3 v = (cube.points[cube.triangles[face + 1][2]] - a) / count;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        const auto at = [&](std::size_t x, std::size_t y) {
          return pointAt(a + static_cast<double>(x) * u + static_cast<double>(y) * v);
        };
        mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }
  return mesh;
}

/// As a Wavefront OBJ file.
inline std::string asObj(const TriangleMesh& mesh) {
  std::ostringstream text;
  text.precision(17);
  for (const Vec3& point : mesh.points) {
    text << "v " << point.x() << ' ' << point.y() << ' ' << point.z() << '\n';
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    text << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
  }
  return text.str();
}

}  // namespace careen
