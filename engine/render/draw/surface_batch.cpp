#include <GL/glcorearb.h>

#include "render/draw/surface_batch.h"

#include <numeric>
#include <utility>

#include "render/gl/gl.h"
#include "render/gl/shader.h"

namespace careen {
namespace {

void appendVertex(std::vector<float>& records, const Surface& surface, const Vec3& corner, double fromRim,
                  double tileSize, const Vec3& eye) {
  append(records, corner - eye);
  append(records, surface.normal);
  // Lengths on a surface are in units of tiles from here on.
  for (const double length :
       {surface.across.dot(corner - surface.origin), surface.along.dot(corner - surface.origin),
        surface.size.x(), surface.size.y()}) {
    records.push_back(static_cast<float>(length / tileSize));
  }
  for (const bool adjoins : surface.adjoins) {
    records.push_back(adjoins ? 1.0F : 0.0F);
  }
  append(records, surface.color);
  records.push_back(static_cast<float>(surface.covering));
  records.push_back(static_cast<float>(fromRim));
}

// A convex outline becomes a triangle fan around its middle, one triangle per edge.
std::vector<float> triangles(const std::vector<Surface>& surfaces, double tileSize, const Vec3& eye) {
  std::vector<float> records;
  for (const Surface& surface : surfaces) {
    const std::size_t count = surface.outline.size();
    const Vec3 middle = std::accumulate(surface.outline.begin(), surface.outline.end(), Vec3(Vec3::Zero())) /
                        static_cast<double>(count);
    for (std::size_t first = 0; first < count; ++first) {
      const Vec3& from = surface.outline[first];
      const Vec3& to = surface.outline[(first + 1) % count];
      const double fromRim = (middle - from).cross((to - from).normalized()).norm();
      appendVertex(records, surface, middle, fromRim, tileSize, eye);
      appendVertex(records, surface, from, 0, tileSize, eye);
      appendVertex(records, surface, to, 0, tileSize, eye);
    }
  }
  return records;
}

}  // namespace

SurfaceBatch::SurfaceBatch(const Gl& gl, const std::filesystem::path& shaders,
                           const std::vector<std::string>& light, std::vector<Surface> surfaces,
                           double tileSize)
    : gl_(gl),
      array_(makeVertexArray(gl)),
      vertices_(gl, {{0, 3}, {1, 3}, {2, 4}, {3, 4}, {4, 4}, {5, 1}}, VertexBuffer::Step::kVertex),
      program_(linkProgram(gl, shaders, with({"surface.vert", "surface.frag"}, light))),
      surfaces_(std::move(surfaces)),
      tileSize_(tileSize) {}

void SurfaceBatch::place(const Vec3& eye) {
  if (eye_ != eye) {
    vertices_.fill(triangles(surfaces_, tileSize_, eye));
    eye_ = eye;
  }
}

void SurfaceBatch::draw() const {
  gl_.UseProgram(program_);
  gl_.BindVertexArray(array_);
  gl_.DrawArrays(GL_TRIANGLES, 0, vertices_.count());
}

}  // namespace careen
