#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/surfaces.h"
#include "render/vertex_array.h"

namespace careen {

struct Gl;

/// Floor and walls. They stand still, so they are laid down once.
class SurfaceBatch {
 public:
  SurfaceBatch(const Gl& gl, const std::filesystem::path& shaders, const std::vector<std::string>& light,
               const std::vector<Surface>& surfaces, double tileSize, const Vec3& eye);
  void draw() const;

 private:
  const Gl& gl_;
  unsigned array_;
  VertexBuffer vertices_;
  unsigned program_;
};

}  // namespace careen
