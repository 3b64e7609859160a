#pragma once

#include <array>
#include <filesystem>
#include <span>

#include "render/draw/decals.h"
#include "render/draw/picture_cells.h"
#include "render/draw/visible_faces.h"
#include "render/gl/vertex_array.h"

namespace careen {

struct Gl;

/// Which boxes keep ambient light from surfaces, and how it is seen.
struct OcclusionView {
  Vec3 eye = Vec3::Zero();  ///< [m]
  double pixelAngle = 0;    ///< [rad]
  double least = 0;         ///< [1] boxes that cover no more of what a point sees are left out
};

/// The part of ambient light that boxes leave to floor and walls: the product over boxes. Copies of a body
/// that is shown at several moments cover as much as so many boxes side by side, at most: what they share
/// counts once. Near a box the map is drawn at half the picture's width and height; far from it, where it
/// varies little, at an eighth.
class OcclusionMap {
 public:
  /// Size of the picture [px].
  OcclusionMap(const Gl& gl, const std::filesystem::path& shaders, int width, int height);

  /// [px] of the picture: so far around it what is drawn into the map near a box changes how surfaces look.
  static constexpr double kReach = 2;
  /// Marks the cells that boxes may reach, and adds them to inputs, if there are any; those that `hidden`
  /// hides are left out.
  void place(std::span<const DrawnBox> boxes, std::span<const Surface> surfaces, const OcclusionView& view,
             const HiddenTiles& hidden, PictureCells& cells, CellInputs* inputs);
  /// Only what is in these cells of the inputs, if there are any.
  void fill(const CellInputs* inputs, const PictureCells::Set& cells);
  /// To draw depths of surfaces that may hide others, then what is far from boxes.
  void beginFar() const;
  void drawFar() const;
  /// To draw depths of surfaces and boxes, then all of it.
  void beginNear() const;
  void drawNear() const;
  /// For programs that draw surfaces.
  void bind() const;

 private:
  struct Target {
    Target(const Gl& gl, int width, int height);
    int width;
    int height;
    unsigned texture = 0;
    unsigned framebuffer = 0;
  };
  void begin(const Target& target) const;
  void drawDecals(unsigned program, std::size_t from, std::size_t to) const;

  const Gl& gl_;
  Target near_;
  Target far_;
  unsigned array_;
  VertexBuffer vertices_;
  IndexBuffer indices_;
  unsigned nearProgram_;
  unsigned copiesProgram_;
  unsigned farProgram_;
  unsigned copyArray_;
  unsigned copyProgram_;
  Decals decals_;
  std::array<std::vector<std::uint32_t>, 3> triangles_;  // of what is far, what is near, and copies
  std::size_t farEnd_ = 0;                               // of indices
  std::size_t nearEnd_ = 0;
  std::size_t copiesEnd_ = 0;
};

}  // namespace careen
