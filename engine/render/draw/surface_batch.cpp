#include <GL/glcorearb.h>

#include "render/draw/surface_batch.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "render/gl/gl.h"
#include "render/gl/shader.h"

namespace careen {
namespace {

constexpr std::size_t kRecord = 23;  // numbers of a vertex, see surface.vert

// What surfaces need in a part of the picture, added.
constexpr int kShaded = 1;
constexpr int kOccluded = 2;

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

SurfaceBatch::SurfaceBatch(const Gl& gl, const std::filesystem::path& shaders, std::vector<std::string> light,
                           std::vector<Surface> surfaces, double tileSize)
    : gl_(gl),
      array_(makeVertexArray(gl)),
      vertices_(gl, {{0, 3}, {1, 3}, {2, 4}, {3, 4}, {4, 4}, {5, 1}, {6, 4}}, VertexBuffer::Step::kVertex),
      shaders_(shaders),
      light_(std::move(light)),
      depthProgram_(linkProgram(gl, shaders, {"depth.vert", "black.frag"})),
      tileSize_(tileSize) {
  replace(std::move(surfaces));
}

void SurfaceBatch::replace(std::vector<Surface> surfaces) {
  surfaces_ = std::move(surfaces);
  std::erase_if(surfaces_, [](const Surface& surface) { return surface.outline.empty(); });
  eye_.reset();
  groups_.clear();
  int first = 0;
  for (const Surface& surface : surfaces_) {
    const int count = 3 * static_cast<int>(surface.outline.size());
    const bool fades = surface.fade > 0;
    if (groups_.empty() || groups_.back().covering != surface.covering || groups_.back().fades != fades) {
      groups_.push_back({.covering = surface.covering, .fades = fades, .first = first});
    }
    groups_.back().count += count;
    first += count;
  }
}

void SurfaceBatch::place(const Vec3& eye) {
  if (eye_ != eye) {
    records_ = triangles(surfaces_, tileSize_, eye);
    vertices_.fill(records_);
    eye_ = eye;
  }
}

unsigned SurfaceBatch::programOf(const Group& group, int needs) {
  const auto covering = static_cast<std::size_t>(group.covering);
  unsigned& program = programs_.at(8 * covering + (group.fades ? 4 : 0) + static_cast<std::size_t>(needs));
  if (program == 0) {
    constexpr std::array<const char*, 3> kPatterns = {"surface_plain.frag", "surface_skirted.frag",
                                                      "surface_tiles.frag"};
    program = linkProgram(gl_, shaders_,
                          with({"surface.vert", "surface.frag", kPatterns.at(covering),
                                group.fades ? "surface_fading.frag" : "surface_endless.frag",
                                (needs & kOccluded) != 0 ? "open_map.frag" : "open_everywhere.frag",
                                (needs & kShaded) != 0 ? "write_shaded.frag" : "write_lit.frag"},
                               light_));
  }
  return program;
}

PictureCells::Set SurfaceBatch::filled(const View& view, int width, int height) const {
  PictureCells::Set cells;
  for (const Surface& surface : surfaces_) {
    if (surface.normal.dot(*eye_ - surface.outline[0]) > 0) {
      cells |= PictureCells::filledBy(view, surface.outline, width, height);
    }
  }
  return cells;
}

void SurfaceBatch::add(CellInputs& inputs) const {
  auto vertices = std::span(records_);
  for (const Surface& surface : surfaces_) {
    const std::size_t own = 3 * surface.outline.size() * kRecord;
    inputs.add(surface.outline, 0, digest(vertices.first(own)));
    vertices = vertices.subspan(own);
  }
}

void SurfaceBatch::draw(const PictureCells& shadows, const PictureCells& occlusion,
                        const PictureCells::Set& cells, int width, int height) {
  constexpr int kNotDrawn = -1;
  std::array<std::vector<PixelRectangle>, 4> parts;  // by what they need
  forRectangles(
      [&](int column, int row) {
        return !cells[PictureCells::indexOf(column, row)]
                   ? kNotDrawn
                   : (shadows.isMarked(column, row) ? kShaded : 0) +
                         (occlusion.isMarked(column, row) ? kOccluded : 0);
      },
      [&](int needs, int column, int endColumn, int row, int endRow) {
        if (needs != kNotDrawn) {
          parts.at(static_cast<std::size_t>(needs))
              .push_back(PictureCells::pixelsOf(column, endColumn, row, endRow, width, height));
        }
      });
  gl_.BindVertexArray(array_);
  gl_.Enable(GL_SCISSOR_TEST);
  gl_.Enable(GL_POLYGON_OFFSET_FILL);
  gl_.PolygonOffset(kSunkSlopes, kSunkSteps);
  for (const Group& group : groups_) {
    for (int needs = 0; needs < 4; ++needs) {
      const std::vector<PixelRectangle>& own = parts.at(static_cast<std::size_t>(needs));
      if (own.empty()) {
        continue;
      }
      ((needs & kShaded) != 0 ? gl_.Enable : gl_.Disable)(GL_BLEND);
      gl_.UseProgram(programOf(group, needs));
      for (const PixelRectangle& at : own) {
        gl_.Scissor(at.left, at.bottom, at.right - at.left, at.top - at.bottom);
        gl_.DrawArrays(GL_TRIANGLES, group.first, group.count);
      }
    }
  }
  gl_.Disable(GL_POLYGON_OFFSET_FILL);
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.Disable(GL_BLEND);
}

void SurfaceBatch::drawBlack() {
  if (blackProgram_ == 0) {
    blackProgram_ = linkProgram(gl_, shaders_,
                                with({"surface.vert", "surface.frag", "surface_plain.frag",
                                      "surface_endless.frag", "open_everywhere.frag", "write_black.frag"},
                                     light_));
  }
  gl_.UseProgram(blackProgram_);
  gl_.BindVertexArray(array_);
  gl_.Enable(GL_POLYGON_OFFSET_FILL);
  gl_.PolygonOffset(kSunkSlopes, kSunkSteps);
  gl_.DrawArrays(GL_TRIANGLES, 0, vertices_.count());
  gl_.Disable(GL_POLYGON_OFFSET_FILL);
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
