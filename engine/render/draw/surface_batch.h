#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/draw/cell_inputs.h"
#include "render/gl/vertex_array.h"
#include "view/surfaces.h"

namespace careen {

struct Gl;

/// Floors and walls, and what lies on them, are behind by this part of what their depth changes in a pixel,
/// and by so many steps of its precision: a box that has sunk into one by less hides it, and what it has
/// drawn is not taken for shadow.
inline constexpr float kSunkSlopes = 0.5F;
inline constexpr float kSunkSteps = 8;

/// Floor and walls. Vertices are recomputed only when the eye has moved, or walls have.
class SurfaceBatch {
 public:
  SurfaceBatch(const Gl& gl, const std::filesystem::path& shaders, std::vector<std::string> light,
               std::vector<Surface> surfaces, double tileSize);
  const std::vector<Surface>& surfaces() const { return surfaces_; }
  /// Others than before: some have moved.
  void replace(std::vector<Surface> surfaces);
  void place(const Vec3& eye);
  void add(CellInputs& inputs) const;
  /// Cells that surfaces fill, so that nothing behind them is seen there.
  PictureCells::Set filled(const View& view, int width, int height) const;
  /// Draws these cells of a canvas of this size [px]: where shadows may reach by blending full light and full
  /// shadow, where boxes occlude with the map of occlusion.
  void draw(const PictureCells& shadows, const PictureCells& occlusion, const PictureCells::Set& cells,
            int width, int height);
  /// Black, but for what lies before them.
  void drawBlack();
  /// Black, a little farther away, for their depth.
  void drawDepth() const;
  /// Those that the eye is behind, as glass over what is drawn.
  void drawGlass();

 private:
  // Consecutive surfaces that are drawn by the same programs.
  struct Group {
    Covering covering = Covering::kPlain;
    bool fades = false;
    int first = 0;  // vertex
    int count = 0;
  };
  unsigned programOf(const Group& group, int needs);

  const Gl& gl_;
  unsigned array_;
  VertexBuffer vertices_;
  std::filesystem::path shaders_;
  std::vector<std::string> light_;
  std::array<unsigned, 24> programs_{};  // made when first used
  unsigned depthProgram_;
  unsigned blackProgram_ = 0;  // made when first used
  unsigned glassProgram_ = 0;  // likewise
  std::vector<Surface> surfaces_;
  std::vector<Group> groups_;
  std::vector<float> records_;
  double tileSize_;
  std::optional<Vec3> eye_;
};

}  // namespace careen
