#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/draw/picture_cells.h"
#include "render/gl/vertex_array.h"
#include "view/surfaces.h"

namespace careen {

struct Gl;

/// Floor and walls. Vertices are recomputed only when the eye has moved, or walls have.
class SurfaceBatch {
 public:
  SurfaceBatch(const Gl& gl, const std::filesystem::path& shaders, const std::vector<std::string>& light,
               std::vector<Surface> surfaces, double tileSize);
  const std::vector<Surface>& surfaces() const { return surfaces_; }
  /// Others than before: some have moved.
  void replace(std::vector<Surface> surfaces);
  void place(const Vec3& eye);
  /// Draws to a canvas of this size [px]: where shadows may reach by blending full light and full shadow,
  /// where boxes occlude with the map of occlusion.
  void draw(const PictureCells& shadows, const PictureCells& occlusion, int width, int height);
  /// Black, but for what lies before them.
  void drawBlack();
  /// Black, a little farther away, for their depth.
  void drawDepth() const;
  /// Those that the eye is behind, as glass over what is drawn.
  void drawGlass();

 private:
  const Gl& gl_;
  unsigned array_;
  VertexBuffer vertices_;
  unsigned programOf(bool shadows, bool occlusion);

  std::filesystem::path shaders_;
  std::vector<std::string> light_;
  std::array<unsigned, 4> programs_{};  // made when first used; 1: shadows, 2: occlusion
  unsigned depthProgram_;
  unsigned blackProgram_ = 0;  // made when first used
  unsigned glassProgram_ = 0;  // likewise
  std::vector<Surface> surfaces_;
  double tileSize_;
  std::optional<Vec3> eye_;
};

}  // namespace careen
