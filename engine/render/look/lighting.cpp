#include "render/look/lighting.h"

#include "view/camera.h"
#include "view/materials.h"

namespace careen {
Lighting lightingOf(Look look, const Camera& camera) {
  const Mat3 worldFromCamera = lookAt(camera.eye, camera.target, camera.up);
  const Vec3 up = camera.up.normalized();
  const Vec3 right = worldFromCamera.col(0);
  const Vec3 back = right.cross(up);
  Lighting lighting;
  const Vec3 towards = -0.55 * right + 1.0 * up + 0.45 * back;
  switch (look) {
    case Look::kStudio:
      lighting.light = Light{.towards = towards, .color = Vec3(0.78, 0.70, 0.58)};
      break;
    case Look::kBlueprint:  // just enough directional light to tell faces apart
      lighting = {.light = Light{.towards = towards, .color = Vec3(0.45, 0.45, 0.45)},
                  .sky = Vec3(0.80, 0.80, 0.80),
                  .ground = Vec3(0.60, 0.60, 0.60),
                  .backgroundTop = Vec3(0.004, 0.018, 0.060),
                  .backgroundBottom = Vec3(0.010, 0.038, 0.110)};
      break;
    case Look::kClay:
      lighting = {.light = Light{.towards = towards, .color = Vec3(0.52, 0.50, 0.47)},
                  .sky = Vec3(0.50, 0.51, 0.53),
                  .ground = Vec3(0.36, 0.34, 0.32),
                  .backgroundTop = Vec3(0.32, 0.33, 0.35),
                  .backgroundBottom = Vec3(0.50, 0.49, 0.48)};
      break;
  }
  return lighting;
}

Lighting lightingOf(const Stage& stage, const Camera& camera) {
  const Scenery& asked = stage.scenery;
  Lighting lighting = lightingOf(stage.picture.look, camera);
  Light& light = *lighting.light;
  light.towards = asked.towardsLight.value_or(light.towards);
  if (asked.lightDegrees) {
    light.spread = slopeOfView(*asked.lightDegrees);
  }
  if (asked.lightColor) {
    light.color = linearFromSrgb(*asked.lightColor);
  }
  if (asked.ambient) {
    lighting.sky = linearFromSrgb(asked.ambient->above);
    lighting.ground = linearFromSrgb(asked.ambient->below);
  }
  if (asked.background) {
    lighting.backgroundTop = linearFromSrgb(asked.background->above);
    lighting.backgroundBottom = linearFromSrgb(asked.background->below);
  }
  return lighting;
}

}  // namespace careen
