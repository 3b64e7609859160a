#include <GL/glcorearb.h>

#include "render/draw/shadow_batch.h"

#include <algorithm>
#include <cmath>

#include "render/draw/light_plane.h"
#include "render/draw/surface_batch.h"
#include "render/gl/gl.h"
#include "render/gl/shader.h"

namespace careen {

ShadowBatch::ShadowBatch(const Gl& gl, const std::filesystem::path& shaders)
    : gl_(gl),
      array_(makeVertexArray(gl)),
      vertices_(gl, kShadowAttributes, VertexBuffer::Step::kVertex),
      indices_(gl),
      program_(linkProgram(gl, shaders, {"shadow.vert", "shadow.frag"})) {}

void ShadowBatch::place(std::span<const DrawnBox> boxes, std::span<const Surface> surfaces,
                        const ShadowLight& light, const Vec3& eye, double pixelAngle,
                        const HiddenTiles& hidden, PictureCells& cells, CellInputs* inputs) {
  decals_ = {};
  for (const Surface& surface : surfaces) {
    const double eyeHeight = surface.normal.dot(eye - surface.outline[0]);
    if (eyeHeight <= 0) {
      continue;
    }
    for (const DrawnBox& box : boxes) {
      // Wide enough for the box's own place and its shadow's, which may be farther away.
      const double distance = (box.pose.position - eye).norm() + box.halfExtents.norm();
      const double steep = std::max(eyeHeight / distance, 0.05);
      const std::vector<Vec3> outline =
          shadowOutline(box, surface, light.towards, light.spread, 2 * pixelAngle * distance / steep);
      if (outline.empty() || hidden.hide(outline)) {
        continue;
      }
      const Zonogon zonogon = zonogonOf(box, light.towards);
      const std::size_t begun = decals_.vertices.size();
      for (const Vec3& corner : outline) {
        appendShadow(decals_.vertices, zonogon, corner, offsetOf(corner, eye), 1);
      }
      cells.mark(outline);
      decals_.addFan(outline.size());
      if (inputs != nullptr) {
        const std::span<const float> vertices = std::span(decals_.vertices).subspan(begun);
        decals_.pieces.add(inputs->add(outline, 0, digest(vertices)), decals_.count);
      }
    }
  }
}

void ShadowBatch::fill(const CellInputs* inputs, const PictureCells::Set& cells) {
  gl_.BindVertexArray(array_);
  vertices_.fill(decals_.vertices);
  indices_.fill(inputs != nullptr ? decals_.pieces.trianglesIn(decals_.triangles, *inputs, cells)
                                  : decals_.triangles);
}

void ShadowBatch::draw() const {
  gl_.UseProgram(program_);
  gl_.BindVertexArray(array_);
  gl_.Disable(GL_CULL_FACE);
  gl_.Enable(GL_POLYGON_OFFSET_FILL);
  gl_.PolygonOffset(kSunkSlopes, kSunkSteps);
  gl_.DrawElements(GL_TRIANGLES, indices_.count(), GL_UNSIGNED_INT, nullptr);
  gl_.Disable(GL_POLYGON_OFFSET_FILL);
  gl_.Enable(GL_CULL_FACE);
}

}  // namespace careen
