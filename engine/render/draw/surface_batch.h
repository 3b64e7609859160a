#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/gl/vertex_array.h"
#include "view/surfaces.h"

namespace careen {

struct Gl;

/// Floor and walls. They are static: vertices are recomputed only when the eye has moved.
class SurfaceBatch {
 public:
  SurfaceBatch(const Gl& gl, const std::filesystem::path& shaders, const std::vector<std::string>& light,
               std::vector<Surface> surfaces, double tileSize);
  const std::vector<Surface>& surfaces() const { return surfaces_; }
  void place(const Vec3& eye);
  void draw() const;

 private:
  const Gl& gl_;
  unsigned array_;
  VertexBuffer vertices_;
  unsigned program_;
  std::vector<Surface> surfaces_;
  double tileSize_;
  std::optional<Vec3> eye_;
};

}  // namespace careen
