#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "render/draw/cell_inputs.h"
#include "render/draw/drawn_box.h"
#include "render/draw/mesh_faces.h"
#include "render/draw/neighbors.h"
#include "render/draw/shadow_pairs.h"

namespace careen {

/// Points of a face at which its occlusion is found: its corners; four more inside, which leave its edges in
/// one piece; or a grid, whose lines divide them.
enum class FaceGrid { kAtCorners, kFramed, kFine };

/// Records of vertices, and triangles between them.
struct VertexRecords {
  std::vector<float> vertices;
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint32_t> outlines;  ///< the same faces in as few triangles as possible
  std::uint32_t count = 0;
  std::vector<std::size_t> triangleEnds;  ///< of each layer, in `triangles`
  std::vector<std::size_t> outlineEnds;   ///< likewise, in `outlines`
  PieceVertices pieces;                   ///< if there are inputs of cells

  /// Triangles between the points of a face, which follow; counterclockwise seen from outside.
  void addFace(FaceGrid grid, bool mirrored);
  void addTriangle();
  void endLayer();
};

/// What BoxBatch::place is given; `neighbors` is null if boxes do not occlude boxes, and `texels` is what
/// neighbors.vert reads of them. Faces are added to `inputs`, if that is not null, with this reach [px] about
/// them and about where they are drawn shrunk by this angle [rad]; none may be of a mesh then.
struct PlacedBoxes {
  std::span<const DrawnBox> boxes;
  std::span<const DrawnFace> faces;
  const FaceShadows& shadows;
  const FaceNeighbors* neighbors;
  std::span<const float> texels;
  std::optional<Vec3> towardsLight;
  Vec3 eye;
  CellInputs* inputs;
  double reach;
  double shrunk;
};

/// The records of all faces and their shadows. Boxes of one moment are a layer.
class FaceRecords {
 public:
  explicit FaceRecords(const PlacedBoxes& placed);

  void add();

  VertexRecords lit;
  VertexRecords dark;
  VertexRecords shaded;
  VertexRecords cast;

 private:
  void findFine();

  std::size_t momentOf(std::size_t face) const { return in_.boxes[in_.faces[face].box].moment; }
  FaceGrid gridOf(std::size_t face) const;
  bool isMesh(std::size_t face) const { return in_.boxes[in_.faces[face].box].mesh != nullptr; }
  bool hasList(std::size_t face) const;

  void appendAbout(std::vector<float>& vertices, double pips, std::size_t face, bool withList) const;

  void addFace(std::size_t i);
  void addPiece(VertexRecords& records, std::size_t begun, std::size_t i);
  void placeList(VertexRecords& records, std::size_t begun, std::size_t face, bool withList) const;
  std::uint64_t listDigest(std::size_t face) const;

  const Zonogon& zonogonOfCaster(std::size_t caster);

  void addShadow(const ShadowPair& pair);

  void addMesh(std::size_t first);

  void addTriangle(VertexRecords& records, const MeshFace& face, const Vec3& color, std::size_t alike,
                   bool withList);

  void addShadow(const MeshFace& face, const Zonogon& zonogon, double weight);

  const PlacedBoxes in_;
  std::vector<bool> isFine_;
  std::vector<bool> isShaded_;
  std::vector<std::size_t> pieces_;  // of faces
  std::vector<std::optional<Zonogon>> zonogons_;
};

/// What neighbors.vert reads: boxes, then the lists of faces.
std::vector<float> neighborTexels(std::span<const DrawnBox> boxes, const FaceNeighbors& neighbors,
                                  const Vec3& eye);

}  // namespace careen
