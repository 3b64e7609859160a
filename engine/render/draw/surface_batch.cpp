#include <GL/glcorearb.h>

#include "render/draw/surface_batch.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "render/gl/gl.h"
#include "render/gl/shader.h"

namespace careen {
namespace {

using Ends = std::array<double, 4>;  // [m] low and high end of the first coordinate, and of the second

Ends endsOf(const Surface& surface) {
  const auto [low, high] = std::minmax_element(
      surface.outline.begin(), surface.outline.end(),
      [&](const Vec3& a, const Vec3& b) { return surface.across.dot(a) < surface.across.dot(b); });
  const auto [near, far] = std::minmax_element(
      surface.outline.begin(), surface.outline.end(),
      [&](const Vec3& a, const Vec3& b) { return surface.along.dot(a) < surface.along.dot(b); });
  return {surface.across.dot(*low), surface.across.dot(*high), surface.along.dot(*near),
          surface.along.dot(*far)};
}

// Distances of a corner from the four ends, in units of the margin in which the surface fades there.
void appendFade(std::vector<float>& records, const Surface& surface, const Ends& ends, const Vec3& corner) {
  constexpr double kNoFade = 2;
  const double across = surface.across.dot(corner);
  const double along = surface.along.dot(corner);
  for (const double distance : {across - ends[0], ends[1] - across, along - ends[2], ends[3] - along}) {
    records.push_back(static_cast<float>(surface.fade > 0 ? distance / surface.fade : kNoFade));
  }
}

void appendVertex(std::vector<float>& records, const Surface& surface, const Ends& ends, const Vec3& corner,
                  double fromRim, double tileSize, const Vec3& eye) {
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
  appendFade(records, surface, ends, corner);
}

// A convex outline becomes a triangle fan around its middle, one triangle per edge.
std::vector<float> triangles(const std::vector<Surface>& surfaces, double tileSize, const Vec3& eye) {
  std::vector<float> records;
  for (const Surface& surface : surfaces) {
    const std::size_t count = surface.outline.size();
    const Ends ends = endsOf(surface);
    const Vec3 middle = std::accumulate(surface.outline.begin(), surface.outline.end(), Vec3(Vec3::Zero())) /
                        static_cast<double>(count);
    for (std::size_t first = 0; first < count; ++first) {
      const Vec3& from = surface.outline[first];
      const Vec3& to = surface.outline[(first + 1) % count];
      const double fromRim = (middle - from).cross((to - from).normalized()).norm();
      appendVertex(records, surface, ends, middle, fromRim, tileSize, eye);
      appendVertex(records, surface, ends, from, 0, tileSize, eye);
      appendVertex(records, surface, ends, to, 0, tileSize, eye);
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
      vertices_(gl, {{0, 3}, {1, 3}, {2, 4}, {3, 4}, {4, 4}, {5, 1}, {6, 4}}, VertexBuffer::Step::kVertex),
      shaders_(shaders),
      light_(light),
      depthProgram_(linkProgram(gl, shaders, {"depth.vert", "black.frag"})),
      tileSize_(tileSize) {
  replace(std::move(surfaces));
}

void SurfaceBatch::replace(std::vector<Surface> surfaces) {
  surfaces_ = std::move(surfaces);
  std::erase_if(surfaces_, [](const Surface& surface) { return surface.outline.empty(); });
  eye_.reset();
}

void SurfaceBatch::place(const Vec3& eye) {
  if (eye_ != eye) {
    vertices_.fill(triangles(surfaces_, tileSize_, eye));
    eye_ = eye;
  }
}

unsigned SurfaceBatch::programOf(bool shadows, bool occlusion) {
  unsigned& program = programs_.at((shadows ? 1 : 0) + (occlusion ? 2 : 0));
  if (program == 0) {
    program = linkProgram(
        gl_, shaders_,
        with({"surface.vert", "surface.frag", occlusion ? "open_map.frag" : "open_everywhere.frag",
              shadows ? "write_shaded.frag" : "write_lit.frag"},
             light_));
  }
  return program;
}

void SurfaceBatch::draw(const PictureCells& shadows, const PictureCells& occlusion, int width, int height) {
  using Row = std::array<int, PictureCells::kColumns>;
  const auto rowOf = [&](int row) {
    Row needs{};
    for (int column = 0; column < PictureCells::kColumns; ++column) {
      needs.at(static_cast<std::size_t>(column)) =
          (shadows.isMarked(column, row) ? 1 : 0) + (occlusion.isMarked(column, row) ? 2 : 0);
    }
    return needs;
  };
  gl_.BindVertexArray(array_);
  gl_.Enable(GL_SCISSOR_TEST);
  for (int row = 0; row < PictureCells::kRows;) {
    const Row needs = rowOf(row);
    int end = row + 1;
    while (end < PictureCells::kRows && rowOf(end) == needs) {
      ++end;
    }
    const int bottom = height * row / PictureCells::kRows;
    const int top = height * end / PictureCells::kRows;
    for (std::size_t column = 0; column < needs.size();) {
      std::size_t last = column;
      while (last < needs.size() && needs.at(last) == needs.at(column)) {
        ++last;
      }
      const int left = width * static_cast<int>(column) / PictureCells::kColumns;
      const int right = width * static_cast<int>(last) / PictureCells::kColumns;
      const bool isShaded = needs.at(column) % 2 != 0;
      (isShaded ? gl_.Enable : gl_.Disable)(GL_BLEND);
      gl_.UseProgram(programOf(isShaded, needs.at(column) >= 2));
      gl_.Scissor(left, bottom, right - left, top - bottom);
      gl_.DrawArrays(GL_TRIANGLES, 0, vertices_.count());
      column = last;
    }
    row = end;
  }
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.Disable(GL_BLEND);
}

void SurfaceBatch::drawBlack() {
  if (blackProgram_ == 0) {
    blackProgram_ = linkProgram(
        gl_, shaders_,
        with({"surface.vert", "surface.frag", "open_everywhere.frag", "write_black.frag"}, light_));
  }
  gl_.UseProgram(blackProgram_);
  gl_.BindVertexArray(array_);
  gl_.DrawArrays(GL_TRIANGLES, 0, vertices_.count());
}

void SurfaceBatch::drawDepth() const {
  gl_.UseProgram(depthProgram_);
  gl_.BindVertexArray(array_);
  gl_.Enable(GL_POLYGON_OFFSET_FILL);
  gl_.PolygonOffset(1, 4);
  gl_.DrawArrays(GL_TRIANGLES, 0, vertices_.count());
  gl_.Disable(GL_POLYGON_OFFSET_FILL);
}

void SurfaceBatch::drawGlass() {
  if (std::none_of(surfaces_.begin(), surfaces_.end(), [&](const Surface& surface) {
        return surface.normal.dot(*eye_ - surface.outline[0]) < 0;
      })) {
    return;
  }
  if (glassProgram_ == 0) {
    glassProgram_ = linkProgram(gl_, shaders_, {"glass.vert", "glass.frag"});
  }
  gl_.UseProgram(glassProgram_);
  gl_.BindVertexArray(array_);
  gl_.CullFace(GL_FRONT);
  gl_.DepthMask(GL_FALSE);
  gl_.Enable(GL_BLEND);
  gl_.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);  // alpha has edges
  gl_.DrawArrays(GL_TRIANGLES, 0, vertices_.count());
  gl_.Disable(GL_BLEND);
  gl_.DepthMask(GL_TRUE);
  gl_.CullFace(GL_BACK);
}

}  // namespace careen
