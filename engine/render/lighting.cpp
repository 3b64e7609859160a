#include "render/lighting.h"

#include <cmath>

#include "render/camera.h"

namespace careen {
namespace {

// IEC 61966-2-1.
double linear(std::uint8_t channel) {
  const double value = channel / 255.0;
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

}  // namespace

Vec3 linearFromSrgb(const Color& color) {
  return {linear(color.red), linear(color.green), linear(color.blue)};
}

Lighting defaultLighting(const Camera& camera) {
  const Mat3 worldFromCamera = lookAt(camera.eye, camera.target, camera.up);
  const Vec3 up = camera.up.normalized();
  const Vec3 right = worldFromCamera.col(0);
  const Vec3 back = right.cross(up);
  Lighting lighting;
  lighting.light = Light{.towards = -0.55 * right + 1.0 * up + 0.45 * back, .color = Vec3(0.78, 0.70, 0.58)};
  return lighting;
}

}  // namespace careen
