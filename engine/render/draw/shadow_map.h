#pragma once

#include <filesystem>

#include "core/math/linear_algebra.h"
#include "render/view/scene_extent.h"

namespace careen {

struct Gl;

inline constexpr int kShadowMapSize = 2048;  // [px] each way

/// From the world to the shadow map's texture coordinates and depth, 0 … 1 for all that `casters` holds, as
/// seen from a light far away in the direction `towards`.
Mat4 shadowFromWorld(const Extent& casters, const Vec3& towards);

/// How far each texel of the light's view is from the light.
class ShadowMap {
 public:
  ShadowMap(const Gl& gl, const std::filesystem::path& shaders);
  /// Drawing goes into the map from now on: depth alone, and of solid bodies the faces turned from the light,
  /// so that no lit face shades itself.
  void begin() const;
  void end() const;

 private:
  const Gl& gl_;
  unsigned texture_ = 0;
  unsigned framebuffer_ = 0;
  unsigned program_;
};

}  // namespace careen
