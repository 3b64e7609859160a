#pragma once

#include <array>

#include "core/math/linear_algebra.h"

namespace careen {

using Float4 = std::array<float, 4>;
using Float16 = std::array<float, 16>;

/// What all shaders of a frame share; laid out as GLSL's std140 wants it. Points are offsets from the eye.
struct FrameBlock {
  Float16 clipFromOffset{};
  Float16 shadowFromOffset{};  ///< to texture coordinates and depth, 0 … 1
  Float4 shadowBounds{};       ///< of what casts shadows, in texture coordinates: least, then greatest
  Float4 towardsLight{};       ///< unit
  Float4 lightColor{};         ///< linear, all of it 0 where there is no light
  Float4 up{};                 ///< unit; where the sky is
  Float4 sky{};                ///< linear
  Float4 ground{};             ///< linear
  Float4 backgroundTop{};      ///< linear
  Float4 backgroundBottom{};   ///< linear
  Float4 finish{};             ///< start of the tone curve's shoulder, 1 with edges in alpha, dither
  Float4 boxLook{};            ///< roughness, 1 with marks, part of its own colour, lines along edges
  Float4 material{};           ///< linear; of all boxes, as far as they have no colour of their own
  Float4 lines{};              ///< linear; w: 1 if joints have this colour
  Float4 surfaceLook{};        ///< roughness of tiles and of walls, contrast of tiles, strength of joints
};

inline Float4 floats(const Vec3& v, double w = 0) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()),
          static_cast<float>(w)};
}

/// Columns first, as GLSL reads them.
inline Float16 floats(const Mat4& m) {
  Float16 values{};
  for (int i = 0; i < 16; ++i) {
    values[static_cast<std::size_t>(i)] = static_cast<float>(m(i % 4, i / 4));
  }
  return values;
}

}  // namespace careen
