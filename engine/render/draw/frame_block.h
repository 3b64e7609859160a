#pragma once

#include <array>
#include <cstddef>

#include "core/math/linear_algebra.h"
#include "render/look/lighting.h"
#include "stage/light_part.h"
#include "view/materials.h"

namespace careen {

using Float4 = std::array<float, 4>;
using Float16 = std::array<float, 16>;

/// Uniform block shared by all shaders of a frame, in GLSL's std140 layout. Points are offsets from the eye.
struct FrameBlock {
  Float16 clipFromOffset{};
  Float4 towardsLight{};   ///< unit; w: [1] how wide penumbras are on each side of an edge, of the distance
  Float4 lightColor{};     ///< linear; all 0 without a light
  Float4 up{};             ///< unit; towards the sky; w: light that comes back from boxes far away
  Float4 sky{};            ///< linear
  Float4 ground{};         ///< linear
  Float4 backgroundTop{};  ///< linear
  Float4 backgroundBottom{};  ///< linear
  Float4 finish{};            ///< start of the tone curve's shoulder, 1 if edges are in alpha, dither;
                              ///< least form factor that counts on boxes
  Float4 boxLook{};           ///< roughness, 1 if marked, part of the box's own colour, width of edge lines
  Float4 material{};          ///< linear; of all boxes, for the part that is not their own colour
  Float4 lines{};             ///< linear; w: 1 if joints have this colour
  Float4 surfaceLook{};       ///< roughness of tiles and of walls, contrast of tiles, strength of joints
  Float4 occlusion{};         ///< shade of a room's corners; least form factor drawn on surfaces,
                              ///< 1 / width and 1 / height of the picture [px]
};

inline Float4 floats(const Vec3& v, double w = 0) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()),
          static_cast<float>(w)};
}

/// Column-major, as in GLSL.
inline Float16 floats(const Mat4& m) {
  Float16 values{};
  for (int i = 0; i < 16; ++i) {
    values[static_cast<std::size_t>(i)] = static_cast<float>(m(i % 4, i / 4));
  }
  return values;
}

/// What all shots of a film have in common.
struct DrawnLook {
  const Lighting& lighting;
  const Materials& materials;
  LightParts parts;
  std::size_t boxes = 0;  ///< of the world
  int width = 0;          ///< [px] of what is drawn
  int height = 0;
  bool wantsEdges = false;  ///< in alpha
};
FrameBlock blockOf(const DrawnLook& look);

/// [1] Width of the curve of shadow.frag that has the variance of a disc, of that disc: sqrt(5) / 2.
inline constexpr double kCurveOfDisc = 1.118033988749895;

/// [1] Least form factor of a box that is drawn, of so many: the more boxes there are, the more they hide
/// each other, and the less each has to be drawn far away.
double leastOcclusion(std::size_t boxes);
/// [1] Likewise, of what keeps light from a box.
double leastOnBoxes(std::size_t boxes);

}  // namespace careen
