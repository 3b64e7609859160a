#include <GL/glcorearb.h>

#include "render/draw/box_batch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>

#include "render/draw/mesh_faces.h"
#include "render/gl/gl.h"
#include "render/gl/shader.h"

namespace careen {
namespace {

constexpr std::array<float, 2> kCoarse = {-1, 1};
// Occlusion changes most beside an edge that another box touches.
constexpr std::array<float, 4> kFine = {-1, -0.6F, 0.6F, 1};
constexpr double kFineWidth = 12;  // [px] of a box's widest face, from which the fine grid shows
constexpr double kFewBoxes = 20;   // of more boxes, only larger ones

constexpr unsigned kNeighborUnit = 1;
constexpr std::size_t kTexturePower = 10;  // of two texels in a row, see neighbors.vert
constexpr std::size_t kTexelsPerBox = 5;
constexpr double kReturned = 1.5;  // boxes are lit from more sides than surfaces: relative to these

constexpr std::initializer_list<Attribute> kFaceAttributes = {{0, 3}, {1, 3}, {2, 3}, {3, 3},
                                                              {4, 4}, {5, 4}, {6, 4}};
constexpr std::array<int, 6> kPips = {1, 6, 2, 5, 3, 4};  // by side; opposite faces add up to seven

std::span<const float> linesOf(bool isFine) {
  return isFine ? std::span<const float>(kFine) : std::span<const float>(kCoarse);
}

// Records of vertices, and triangles between them.
struct Records {
  std::vector<float> vertices;
  std::vector<std::uint32_t> triangles;
  std::uint32_t count = 0;

  // Triangles of a grid whose vertices follow; counterclockwise seen from outside.
  void addGrid(std::size_t lines, bool mirrored) {
    const auto width = static_cast<std::uint32_t>(lines);
    for (std::uint32_t v = 0; v + 1 < width; ++v) {
      for (std::uint32_t u = 0; u + 1 < width; ++u) {
        const std::uint32_t at = count + v * width + u;
        const std::uint32_t right = mirrored ? at + width : at + 1;
        const std::uint32_t above = mirrored ? at + 1 : at + width;
        triangles.insert(triangles.end(), {at, right, at + width + 1, at, at + width + 1, above});
      }
    }
    count += width * width;
  }
};

// Does something with the points of a face's grid: calls with the point and its place on the face, −1 … 1.
// Neighbouring faces have the very same points on the edge between them, so that there are no cracks.
template <class Do>
void forGrid(const DrawnBox& box, const DrawnFace& face, bool isFine, const Do& doWith) {
  const int axis = face.side / 2;
  Vec3 place;
  place[axis] = face.side % 2 == 0 ? 1 : -1;
  for (const float v : linesOf(isFine)) {
    for (const float u : linesOf(isFine)) {
      place[(axis + 1) % 3] = u;
      place[(axis + 2) % 3] = v;
      doWith(box.pose.worldPoint(box.halfExtents.cwiseProduct(place)), u, v);
    }
  }
}

// See neighbors.vert.
std::vector<float> neighborTexels(std::span<const DrawnBox> boxes, const Neighbors& neighbors,
                                  const Vec3& eye) {
  std::vector<float> texels;
  texels.reserve(4 * (kTexelsPerBox * boxes.size() + neighbors.entries.size()));
  for (const DrawnBox& box : boxes) {
    const Vec3 centre = box.pose.worldFromBody.transpose() * (box.pose.position - eye);
    for (int axis = 0; axis < 3; ++axis) {
      append(texels, box.pose.worldFromBody.col(axis));
      texels.push_back(static_cast<float>(-centre[axis]));
    }
    append(texels, box.halfExtents);
    texels.push_back(0);
    append(texels, kReturned * box.returned);
    texels.push_back(0);
  }
  for (const Neighbors::Entry& entry : neighbors.entries) {
    texels.insert(texels.end(),
                  {static_cast<float>(kTexelsPerBox * entry.box), static_cast<float>(entry.weight), 0, 0});
  }
  return texels;
}

// What BoxBatch::place is given; `neighbors` is null if boxes do not occlude boxes.
struct Placed {
  std::span<const DrawnBox> boxes;
  std::span<const DrawnFace> faces;
  const FaceShadows& shadows;
  const Neighbors* neighbors;
  std::optional<Vec3> towardsLight;
  Vec3 eye;
};

// The records of all faces and their shadows.
class FaceRecords {
 public:
  explicit FaceRecords(const Placed& placed)
      : in_(placed),
        isFine_(placed.boxes.size()),
        isShaded_(placed.faces.size()),
        zonogons_(placed.boxes.size()) {
    if (in_.neighbors != nullptr) {
      findFine();
    }
    for (const ShadowPair& pair : in_.shadows.pairs) {
      isShaded_[pair.face] = true;
    }
  }

  void add() {
    for (std::size_t i = 0; i < in_.faces.size(); ++i) {
      if (!isMesh(i)) {
        addFace(i);
      } else if (i == 0 || in_.faces[i - 1].box != in_.faces[i].box) {
        addMesh(i);
      }
    }
    for (const ShadowPair& pair : in_.shadows.pairs) {
      if (!isMesh(pair.face)) {
        addShadow(pair);
      }
    }
  }

  Records lit;
  Records dark;
  Records shaded;
  Records cast;

 private:
  // All faces of a box have the same grid.
  void findFine() {
    const double many = std::max(1.0, static_cast<double>(in_.boxes.size()) / kFewBoxes);
    const double fineWidth = kFineWidth * std::sqrt(many * std::sqrt(many));
    for (std::size_t i = 0; i < in_.faces.size(); ++i) {
      if (in_.faces[i].widestOfBox >= fineWidth && hasList(i)) {
        isFine_[in_.faces[i].box] = true;
      }
    }
  }

  bool isMesh(std::size_t face) const { return in_.boxes[in_.faces[face].box].mesh != nullptr; }
  bool hasList(std::size_t face) const {
    return in_.neighbors != nullptr && !in_.neighbors->of(face).empty();
  }

  void appendAbout(std::vector<float>& vertices, double pips, std::size_t face, bool withList) const {
    vertices.push_back(static_cast<float>(pips));
    vertices.push_back(static_cast<float>(in_.faces[face].width));
    const std::size_t lists = kTexelsPerBox * in_.boxes.size();
    vertices.push_back(withList ? static_cast<float>(lists + in_.neighbors->begins[face]) : 0.0F);
    vertices.push_back(withList ? static_cast<float>(in_.neighbors->of(face).size()) : 0.0F);
  }

  void addFace(std::size_t i) {
    const DrawnFace& face = in_.faces[i];
    const DrawnBox& box = in_.boxes[face.box];
    const int axis = face.side / 2;
    const Vec3 across = box.pose.worldFromBody.col((axis + 1) % 3);
    const Vec3 along = box.pose.worldFromBody.col((axis + 2) % 3);
    const double width = box.halfExtents[(axis + 1) % 3];
    const double height = box.halfExtents[(axis + 2) % 3];
    Records& records = in_.shadows.isDark[i] ? dark : isShaded_[i] ? shaded : lit;
    records.addGrid(linesOf(isFine_[face.box]).size(), face.side % 2 != 0);
    forGrid(box, face, isFine_[face.box], [&](const Vec3& point, double u, double v) {
      std::vector<float>& vertices = records.vertices;
      append(vertices, point - in_.eye);
      append(vertices, face.normal);
      append(vertices, across);
      append(vertices, along);
      for (const double value : {u * width, v * height, width, height}) {
        vertices.push_back(static_cast<float>(value));
      }
      append(vertices, box.color);
      vertices.push_back(box.marked ? 1.0F : 0.0F);
      appendAbout(vertices, kPips.at(static_cast<std::size_t>(face.side)), i, hasList(i));
    });
  }

  const Zonogon& zonogonOfCaster(std::size_t caster) {
    std::optional<Zonogon>& zonogon = zonogons_[caster];
    zonogon = zonogon ? zonogon : zonogonOf(in_.boxes[caster], *in_.towardsLight);
    return *zonogon;
  }

  void addShadow(const ShadowPair& pair) {
    const DrawnFace& face = in_.faces[pair.face];
    const Zonogon& zonogon = zonogonOfCaster(pair.caster);
    cast.addGrid(linesOf(isFine_[face.box]).size(), face.side % 2 != 0);
    forGrid(in_.boxes[face.box], face, isFine_[face.box], [&](const Vec3& point, double, double) {
      appendShadow(cast.vertices, zonogon, point, offsetOf(point, in_.eye), pair.weight);
    });
  }

  // In place of a box's faces, which are `first` and those that follow it. The boxes that shade or occlude
  // one of them do so with the mesh: each triangle is occluded as the face that it looks most like.
  void addMesh(std::size_t first) {
    const DrawnBox& box = in_.boxes[in_.faces[first].box];
    std::size_t end = first;
    while (end < in_.faces.size() && in_.faces[end].box == in_.faces[first].box) {
      ++end;
    }
    std::map<std::size_t, double> casters;
    for (const ShadowPair& pair : in_.shadows.pairs) {
      if (pair.face >= first && pair.face < end) {
        casters[pair.caster] = std::max(casters[pair.caster], pair.weight);
      }
    }
    for (const MeshFace& face : meshFacesTowards(*box.mesh, box.pose, in_.eye)) {
      std::size_t alike = first;
      const auto likeness = [&](std::size_t i) { return in_.faces[i].normal.dot(face.normal); };
      for (std::size_t i = first; i < end; ++i) {
        alike = likeness(i) > likeness(alike) ? i : alike;
      }
      const bool isDark = in_.towardsLight && !(face.normal.dot(*in_.towardsLight) > 0);
      Records& records = isDark ? dark : casters.empty() ? lit : shaded;
      addTriangle(records, face, box.color, alike, likeness(alike) > 0 && hasList(alike));
      if (!isDark) {
        for (const auto& [caster, weight] : casters) {
          addShadow(face, zonogonOfCaster(caster), weight);
        }
      }
    }
  }

  void addTriangle(Records& records, const MeshFace& face, const Vec3& color, std::size_t alike,
                   bool withList) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      std::vector<float>& vertices = records.vertices;
      records.triangles.push_back(records.count++);
      append(vertices, face.corners.at(corner) - in_.eye);
      append(vertices, face.normal);
      append(vertices, face.outward[0]);
      append(vertices, face.outward[1]);
      for (const double value :
           {face.place.at(corner)[0], face.place.at(corner)[1], face.height[0], face.height[1]}) {
        vertices.push_back(static_cast<float>(value));
      }
      append(vertices, color);
      vertices.push_back(0);  // no marks
      appendAbout(vertices, 0, alike, withList);
    }
  }

  void addShadow(const MeshFace& face, const Zonogon& zonogon, double weight) {
    for (const Vec3& corner : face.corners) {
      cast.triangles.push_back(cast.count++);
      appendShadow(cast.vertices, zonogon, corner, offsetOf(corner, in_.eye), weight);
    }
  }

  const Placed in_;
  std::vector<bool> isFine_;
  std::vector<bool> isShaded_;
  std::vector<std::optional<Zonogon>> zonogons_;
};

}  // namespace

BoxBatch::Mesh::Mesh(const Gl& gl, std::initializer_list<Attribute> attributes)
    : array(makeVertexArray(gl)), vertices(gl, attributes, VertexBuffer::Step::kVertex), indices(gl) {}

BoxBatch::BoxBatch(const Gl& gl, const std::filesystem::path& shaders, const LightShaders& light)
    : gl_(gl),
      neighbors_(light.neighbors),
      hasLight_(light.light),
      lit_(gl, kFaceAttributes),
      dark_(gl, kFaceAttributes),
      shaded_(gl, kFaceAttributes),
      shadows_(gl, kShadowAttributes) {
  const char* const openness = light.neighbors ? "neighbors.vert" : "open_everywhere.vert";
  const auto program = [&](const char* write) {
    const unsigned linked =
        linkProgram(gl, shaders, with({"box.vert", openness, "box.frag", write}, light.common));
    if (light.neighbors) {
      gl.UseProgram(linked);
      gl.Uniform1i(gl.GetUniformLocation(linked, "neighbors"), kNeighborUnit);
    }
    return linked;
  };
  litProgram_ = program("write_lit.frag");
  if (light.light) {
    darkProgram_ = program("write_dark.frag");
  }
  if (light.shadows) {
    shadedProgram_ = program("write_shaded.frag");
    depthProgram_ = linkProgram(gl, shaders, {"depth.vert", "black.frag"});
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

void BoxBatch::place(std::span<const DrawnBox> boxes, std::span<const DrawnFace> faces,
                     const FaceShadows& shadows, const Neighbors& neighbors, const Vec3& towardsLight,
                     const Vec3& eye) {
  FaceRecords records({.boxes = boxes,
                       .faces = faces,
                       .shadows = shadows,
                       .neighbors = neighbors_ ? &neighbors : nullptr,
                       .towardsLight = hasLight_ ? std::optional(towardsLight) : std::nullopt,
                       .eye = eye});
  records.add();
  const auto fill = [&](Mesh& mesh, const Records& of) {
    gl_.BindVertexArray(mesh.array);
    mesh.vertices.fill(of.vertices);
    mesh.indices.fill(of.triangles);
  };
  fill(lit_, records.lit);
  fill(dark_, records.dark);
  fill(shaded_, records.shaded);
  fill(shadows_, records.cast);
  if (neighbors_) {
    fillNeighbors(neighborTexels(boxes, neighbors, eye));
  }
}

void BoxBatch::fillNeighbors(std::vector<float> texels) const {
  constexpr std::size_t kRow = std::size_t{1} << kTexturePower;
  const std::size_t rows = std::max<std::size_t>(1, (texels.size() / 4 + kRow - 1) / kRow);
  texels.resize(4 * kRow * rows);
  gl_.ActiveTexture(GL_TEXTURE0 + kNeighborUnit);
  gl_.BindTexture(GL_TEXTURE_2D, neighborTexture_);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, kRow, static_cast<GLsizei>(rows), 0, GL_RGBA, GL_FLOAT,
                 texels.data());
  gl_.ActiveTexture(GL_TEXTURE0);
}

void BoxBatch::draw(const Mesh& mesh) const {
  if (mesh.indices.count() > 0) {
    gl_.BindVertexArray(mesh.array);
    gl_.DrawElements(GL_TRIANGLES, mesh.indices.count(), GL_UNSIGNED_INT, nullptr);
  }
}

void BoxBatch::drawUnshaded() const {
  gl_.UseProgram(litProgram_);
  draw(lit_);
  gl_.UseProgram(darkProgram_);
  draw(dark_);
}

void BoxBatch::drawShadedDepth() const {
  gl_.UseProgram(depthProgram_);
  draw(shaded_);
}

void BoxBatch::drawShadows() const {
  gl_.UseProgram(shadowProgram_);
  draw(shadows_);
}

void BoxBatch::drawShaded() const {
  gl_.UseProgram(shadedProgram_);
  draw(shaded_);
}

void BoxBatch::drawShrunk(double angle) const {
  gl_.UseProgram(shrunkProgram_);
  gl_.Uniform1f(shrinkPlace_, static_cast<float>(angle));
  draw(lit_);
  draw(dark_);
  draw(shaded_);
}

}  // namespace careen
