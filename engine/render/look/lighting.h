#pragma once

#include <optional>

#include "core/math/linear_algebra.h"
#include "stage/camera.h"
#include "stage/color.h"
#include "stage/picture_settings.h"

namespace careen {

/// Linear light, red green blue: 1 is a white sheet at its brightest.
Vec3 linearFromSrgb(const Color& color);

/// A light as far away as the sun.
struct Light {
  Vec3 towards = Vec3::UnitZ();  ///< where it stands, world frame; any length but 0
  Vec3 color = Vec3::Ones();     ///< linear; what a white face turned to it sends back
  bool castsShadow = true;
};

/// Everything that shines. No light, no shadow pass.
struct Lighting {
  std::optional<Light> light;
  Vec3 sky = Vec3(0.36, 0.40, 0.46);     ///< linear; what a white face turned up gets from all around
  Vec3 ground = Vec3(0.24, 0.21, 0.19);  ///< linear; the same for one turned down
  Vec3 backgroundTop = Vec3(0.035, 0.055, 0.080);
  Vec3 backgroundBottom = Vec3(0.19, 0.225, 0.255);
};

/// A look's light. It comes over the left shoulder of the camera; in the studio it is warm, and a soft blue
/// comes from above.
Lighting lightingOf(Look look, const Camera& camera);

}  // namespace careen
