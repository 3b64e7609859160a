#include <GL/glcorearb.h>

#include "render/draw/box_batch.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "render/gl/gl.h"
#include "render/gl/shader.h"
#include "render/gl/texture_units.h"

namespace careen {
namespace {

// Depth that the same faces are drawn over later, in other triangles, and layers after the first are behind
// by this part of what it changes in a pixel, and by so many steps of its precision.
constexpr float kBehindSlopes = 0.05F;
constexpr float kBehindSteps = 8;

constexpr std::size_t kTexturePower = 10;  // of two texels in a row, see neighbors.vert

constexpr std::initializer_list<Attribute> kFaceAttributes = {{0, 3}, {1, 3}, {2, 3}, {3, 3},
                                                              {4, 4}, {5, 4}, {6, 4}, {7, 3}};
}  // namespace

BoxBatch::Mesh::Mesh(const Gl& gl, std::initializer_list<Attribute> attributes)
    : array(makeVertexArray(gl)), vertices(gl, attributes, VertexBuffer::Step::kVertex), indices(gl) {}

BoxBatch::BoxBatch(const Gl& gl, const std::filesystem::path& shaders, const LightShaders& light)
    : gl_(gl),
      shaders_(shaders),
      light_(light),
      lit_(gl, kFaceAttributes),
      dark_(gl, kFaceAttributes),
      shaded_(gl, kFaceAttributes),
      shadows_(gl, kShadowAttributes) {
  litProgram_ = programThat("write_lit.frag");
  depthProgram_ = linkProgram(gl, shaders, {"depth.vert", "black.frag"});
  if (light.light) {
    darkProgram_ = programThat("write_dark.frag");
  }
  if (light.shadows) {
    shadedProgram_ = programThat("write_shaded.frag");
    shadowProgram_ = linkProgram(gl, shaders, {"shadow.vert", "shadow.frag"});
  }
  if (light.occlusion) {
    shrunkProgram_ = linkProgram(gl, shaders, {"box_shrunk.vert", "black.frag"});
    shrinkPlace_ = gl.GetUniformLocation(shrunkProgram_, "shrink");
  }
  if (light.neighbors) {
    gl.GenTextures(1, &neighborTexture_);
    gl.ActiveTexture(GL_TEXTURE0 + kNeighborUnit);
    gl.BindTexture(GL_TEXTURE_2D, neighborTexture_);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl.ActiveTexture(GL_TEXTURE0);
  }
}

unsigned BoxBatch::programThat(const char* write) const {
  const char* const openness = light_.neighbors ? "neighbors.vert" : "open_everywhere.vert";
  const unsigned linked =
      linkProgram(gl_, shaders_, with({"box.vert", openness, "box.frag", write}, light_.common));
  if (light_.neighbors) {
    gl_.UseProgram(linked);
    gl_.Uniform1i(gl_.GetUniformLocation(linked, "neighbors"), kNeighborUnit);
  }
  return linked;
}

void BoxBatch::place(PlacedBoxes placed) {
  texels_ =
      light_.neighbors ? neighborTexels(placed.boxes, *placed.neighbors, placed.eye) : std::vector<float>();
  placed.texels = texels_;
  placed.neighbors = light_.neighbors ? placed.neighbors : nullptr;
  placed.towardsLight = light_.light ? placed.towardsLight : std::nullopt;
  FaceRecords records(placed);
  records.add();
  lit_.records = std::move(records.lit);
  dark_.records = std::move(records.dark);
  shaded_.records = std::move(records.shaded);
  shadows_.records = std::move(records.cast);
}

void BoxBatch::fill(const CellInputs* inputs, const PictureCells::Set& cells) {
  for (Mesh* const mesh : {&lit_, &dark_, &shaded_, &shadows_}) {
    VertexRecords& of = mesh->records;
    if (inputs != nullptr) {  // of one layer
      of.triangles = of.pieces.trianglesIn(of.triangles, *inputs, cells);
      of.outlines = of.pieces.trianglesIn(of.outlines, *inputs, cells);
      of.triangleEnds = {of.triangles.size()};
      of.outlineEnds = {of.outlines.size()};
    }
    gl_.BindVertexArray(mesh->array);
    mesh->vertices.fill(of.vertices);
    mesh->triangleEnds = of.triangleEnds;
    mesh->outlineEnds = of.outlineEnds;
    for (std::size_t& end : mesh->outlineEnds) {
      end += of.triangles.size();
    }
    std::vector<std::uint32_t> indices = std::move(of.triangles);
    indices.insert(indices.end(), of.outlines.begin(), of.outlines.end());
    mesh->indices.fill(indices);
    of = {};
  }
  if (light_.neighbors) {
    fillNeighbors();
  }
}

void BoxBatch::fillNeighbors() const {
  constexpr std::size_t kRow = std::size_t{1} << kTexturePower;
  const std::size_t rows = std::max<std::size_t>(1, (texels_.size() / 4 + kRow - 1) / kRow);
  std::vector<float> texels = texels_;
  texels.resize(4 * kRow * rows);
  gl_.ActiveTexture(GL_TEXTURE0 + kNeighborUnit);
  gl_.BindTexture(GL_TEXTURE_2D, neighborTexture_);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, kRow, static_cast<GLsizei>(rows), 0, GL_RGBA, GL_FLOAT,
                 texels.data());
  gl_.ActiveTexture(GL_TEXTURE0);
}

void BoxBatch::draw(const Mesh& mesh, std::size_t from, std::size_t to) const {
  if (to > from) {
    gl_.BindVertexArray(mesh.array);
    const std::size_t place = from * sizeof(std::uint32_t);
    const void* const first = reinterpret_cast<const void*>(place);  // NOLINT(performance-no-int-to-ptr)
    gl_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(to - from), GL_UNSIGNED_INT, first);
  }
}

void BoxBatch::drawTriangles(const Mesh& mesh, std::size_t layer) const {
  if (layer < mesh.triangleEnds.size()) {
    draw(mesh, layer == 0 ? 0 : mesh.triangleEnds[layer - 1], mesh.triangleEnds[layer]);
  }
}

void BoxBatch::drawOutlines(const Mesh& mesh, std::size_t layer) const {
  if (layer < mesh.outlineEnds.size()) {
    draw(mesh, layer == 0 ? mesh.triangleEnds.back() : mesh.outlineEnds[layer - 1], mesh.outlineEnds[layer]);
  }
}

void BoxBatch::moveBehind(std::size_t steps) const {
  if (steps == 0) {
    gl_.Disable(GL_POLYGON_OFFSET_FILL);
  } else {
    gl_.Enable(GL_POLYGON_OFFSET_FILL);
    gl_.PolygonOffset(kBehindSlopes * static_cast<float>(steps), kBehindSteps * static_cast<float>(steps));
  }
}

void BoxBatch::drawUnshaded(std::size_t layer) const {
  moveBehind(layer == 0 ? 0 : 1);
  gl_.UseProgram(litProgram_);
  drawTriangles(lit_, layer);
  gl_.UseProgram(darkProgram_);
  drawTriangles(dark_, layer);
  moveBehind(0);
}

void BoxBatch::drawShadedDepth(std::size_t layer) const {
  gl_.UseProgram(depthProgram_);
  moveBehind(layer == 0 ? 1 : 2);
  drawOutlines(shaded_, layer);
  moveBehind(0);
}

void BoxBatch::drawShadows(std::size_t layer) const {
  moveBehind(layer == 0 ? 0 : 1);
  gl_.UseProgram(shadowProgram_);
  drawOutlines(shadows_, layer);
  moveBehind(0);
}

void BoxBatch::drawShaded(std::size_t layer) const {
  moveBehind(layer == 0 ? 0 : 1);
  gl_.UseProgram(shadedProgram_);
  drawTriangles(shaded_, layer);
  moveBehind(0);
}

void BoxBatch::drawDepth(std::size_t layer) const {
  gl_.Enable(GL_BLEND);
  gl_.BlendFuncSeparate(GL_ZERO, GL_ONE, GL_ZERO, GL_ONE);  // no colour
  gl_.UseProgram(depthProgram_);
  for (const Mesh* const mesh : {&lit_, &dark_, &shaded_}) {
    drawOutlines(*mesh, layer);
  }
  gl_.Disable(GL_BLEND);
}

void BoxBatch::drawCoverage(std::size_t layer) {
  if (coverageProgram_ == 0) {
    coverageProgram_ = programThat("write_white.frag");
  }
  gl_.UseProgram(coverageProgram_);
  for (const Mesh* const mesh : {&lit_, &dark_, &shaded_}) {
    drawTriangles(*mesh, layer);
  }
}

void BoxBatch::drawShrunk(double angle) const {
  gl_.UseProgram(shrunkProgram_);
  gl_.Uniform1f(shrinkPlace_, static_cast<float>(angle));
  for (std::size_t layer = 0; layer < layers(); ++layer) {
    for (const Mesh* const mesh : {&lit_, &dark_, &shaded_}) {
      drawOutlines(*mesh, layer);
    }
  }
}

}  // namespace careen
