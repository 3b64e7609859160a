#pragma once

#include <filesystem>

#include "core/math/linear_algebra.h"
#include "view/scene_extent.h"

namespace careen {

struct Gl;

inline constexpr int kShadowMapSize = 2048;  // [px] width and height

/// From the world to the shadow map's texture coordinates and depth, 0 … 1 for everything in `casters`, for a
/// directional light in the direction `towards`.
Mat4 shadowFromWorld(const Extent& casters, const Vec3& towards);

/// Depth of the scene as seen from the light.
class ShadowMap {
 public:
  ShadowMap(const Gl& gl, const std::filesystem::path& shaders);
  /// Binds the map for drawing: depth only, and only back faces as seen from the light, which avoids shadow
  /// acne.
  void begin() const;
  void end() const;

 private:
  const Gl& gl_;
  unsigned texture_ = 0;
  unsigned framebuffer_ = 0;
  unsigned program_;
};

}  // namespace careen
