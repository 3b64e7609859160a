#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "core/system/release.h"
#include "image/picture.h"
#include "render/draw/renderer.h"
#include "render/gl/rendering_backend.h"
#include "render/look/lighting.h"
#include "support/stages.h"

namespace careen {

// What tests of drawing share: small scenes in code (support/stages.h), and colours worked out beside the
// engine.

/// Whether this release of the system has OSMesa, so that it must be there: Mesa gave it up in 25.1.
inline bool releaseHasOsMesa() { return drawingPackages() == "libosmesa6"; }

/// No library of any backend can be loaded.
inline ContextOptions nowhereToDraw() {
  ContextOptions options;
  options.osMesaLibrary = "libNoSuchMesa.so";
  options.eglLibrary = "libNoSuchEgl.so";
  return options;
}

/// Light from all around alike, none from any side: what is drawn has its own colour.
inline Lighting evenLighting(const Vec3& background = Vec3::Zero()) {
  return {.light = std::nullopt,
          .sky = Vec3::Ones(),
          .ground = Vec3::Ones(),
          .backgroundTop = background,
          .backgroundBottom = background};
}

/// So lit, and nothing done to the light on its way into the picture.
inline RenderOptions lit(const Lighting& lighting) {
  RenderOptions options;
  options.lighting = lighting;
  options.materials = Materials{.occlusion = false, .shoulder = 1e9, .dither = 0};  // light stays as it is
  return options;
}

/// An open floor under a camera, every pixel drawn once.
inline Scene onOpenFloor(const Camera& camera) {
  Scene scene;
  scene.gravity = Vec3::Zero();
  scene.room.emplace();
  scene.room->min = Vec3(-30, -30, 0);
  scene.room->max = Vec3(30, 30, 9);
  scene.room->open = {true, true, true, true, false, true};
  scene.camera = camera;
  scene.picture.antialiasing = Antialiasing::kOff;
  return scene;
}

/// 8-bit sRGB of a linear value (IEC 61966-2-1).
inline int srgbFromLinear(double value) {
  const double clamped = std::clamp(value, 0.0, 1.0);
  const double encoded = clamped <= 0.0031308 ? 12.92 * clamped : 1.055 * std::pow(clamped, 1 / 2.4) - 0.055;
  return static_cast<int>(std::lround(255 * encoded));
}

inline std::array<int, 3> pixelAt(const Picture& picture, int x, int y) {
  const std::size_t place =
      static_cast<std::size_t>(y) * picture.rowBytes() + 3 * static_cast<std::size_t>(x);
  return {picture.rgb.at(place), picture.rgb.at(place + 1), picture.rgb.at(place + 2)};
}

}  // namespace careen
