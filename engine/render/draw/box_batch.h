#pragma once

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "render/draw/face_records.h"
#include "render/gl/vertex_array.h"

namespace careen {

struct Gl;

/// Shaders of a frame that depend on its light.
struct LightShaders {
  std::vector<std::string> common;  ///< light and finish
  bool light = false;               ///< there is a source, from which faces may be turned away
  bool shadows = false;             ///< some faces may be in shadow
  bool occlusion = false;           ///< of surfaces by boxes
  bool neighbors = false;           ///< boxes occlude boxes
};

/// The faces of boxes that the eye sees: those that shadows reach, those without direct light, and the
/// others.
class BoxBatch {
 public:
  BoxBatch(const Gl& gl, const std::filesystem::path& shaders, const LightShaders& light);

  /// What is drawn from now on, once it is filled in. `texels` and `towardsLight` are ignored if boxes do not
  /// occlude boxes, or there is no light.
  void place(PlacedBoxes placed);
  /// Only what is in these cells of the inputs, if there are any.
  void fill(const CellInputs* inputs, const PictureCells::Set& cells);

  bool hasShaded() const { return shaded_.indices.count() > 0; }
  /// Boxes of one moment are a layer; there is one at least, be it empty. What a layer draws is not seen
  /// where it lies in a plane with a layer before it, which else would show through in places.
  std::size_t layers() const { return std::max<std::size_t>(1, lit_.triangleEnds.size()); }
  /// Faces that no shadow reaches, in full light, and those that have no direct light.
  void drawUnshaded(std::size_t layer) const;
  /// Faces that shadows may reach: black, for their depth, a little behind them; their shadows, to be added;
  /// then their colours, to be blended.
  void drawShadedDepth(std::size_t layer) const;
  void drawShadows(std::size_t layer) const;
  void drawShaded(std::size_t layer) const;
  /// Depth of all faces as it is, for the layers that follow.
  void drawDepth(std::size_t layer) const;
  /// All faces in white.
  void drawCoverage(std::size_t layer);
  /// Depth of all faces of boxes shrunk by this angle [rad].
  void drawShrunk(double angle) const;

 private:
  struct Mesh {
    Mesh(const Gl& gl, std::initializer_list<Attribute> attributes);
    unsigned array;
    VertexBuffer vertices;
    IndexBuffer indices;
    VertexRecords records;
    std::vector<std::size_t> triangleEnds;  // of the layers' indices
    std::vector<std::size_t> outlineEnds;   // then come the same faces in fewer triangles
  };
  void drawTriangles(const Mesh& mesh, std::size_t layer) const;
  void drawOutlines(const Mesh& mesh, std::size_t layer) const;
  void draw(const Mesh& mesh, std::size_t from, std::size_t to) const;
  void moveBehind(std::size_t steps) const;
  void fillNeighbors() const;
  unsigned programThat(const char* write) const;

  const Gl& gl_;
  std::filesystem::path shaders_;
  LightShaders light_;
  std::vector<float> texels_;
  Mesh lit_;
  Mesh dark_;
  Mesh shaded_;
  Mesh shadows_;
  unsigned litProgram_ = 0;
  unsigned darkProgram_ = 0;
  unsigned depthProgram_ = 0;
  unsigned shrunkProgram_ = 0;
  unsigned shadedProgram_ = 0;
  unsigned shadowProgram_ = 0;
  unsigned coverageProgram_ = 0;  // made when first used
  int shrinkPlace_ = 0;
  unsigned neighborTexture_ = 0;
};

}  // namespace careen
