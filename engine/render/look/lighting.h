#pragma once

#include <optional>

#include "core/math/linear_algebra.h"
#include "stage/camera.h"
#include "stage/picture_settings.h"
#include "stage/stage.h"

namespace careen {

/// A directional light.
struct Light {
  Vec3 towards = Vec3::UnitZ();  ///< direction towards the light, world frame; any length but 0
  Vec3 color = Vec3::Ones();     ///< linear; as reflected by a white face turned towards it
  bool castsShadow = true;
  double spread = 0.03;  ///< tangent of half the angle that it covers: penumbrae are that slope wide
};

/// All lighting. Without `light` there is no shadow pass.
struct Lighting {
  std::optional<Light> light;
  Vec3 sky = Vec3(0.36, 0.40, 0.46);     ///< linear; ambient light on a white face that points up
  Vec3 ground = Vec3(0.24, 0.21, 0.19);  ///< linear; likewise, pointing down
  Vec3 backgroundTop = Vec3(0.035, 0.055, 0.080);
  Vec3 backgroundBottom = Vec3(0.19, 0.225, 0.255);
};

/// The lighting of a look. The light comes over the camera's left shoulder; in the studio look it is warm,
/// with soft blue ambient light from above.
Lighting lightingOf(Look look, const Camera& camera);
/// The same with what the scene says of it.
Lighting lightingOf(const Stage& stage, const Camera& camera);

}  // namespace careen
