#include "view/materials.h"

#include <cmath>
#include <cstdint>

namespace careen {
namespace {

constexpr double kSmoothest = 0.9;  // [1] of the range of roughness: of a mirror, no highlight is seen

// IEC 61966-2-1.
double linear(std::uint8_t channel) {
  const double value = channel / 255.0;
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

}  // namespace

Vec3 linearFromSrgb(const Color& color) {
  return {linear(color.red), linear(color.green), linear(color.blue)};
}

Materials materialsOf(Look look) {
  switch (look) {
    case Look::kStudio:
      break;
    case Look::kBlueprint:
      return {.boxRoughness = 1,
              .ownColor = 0.12,
              .boxColor = Vec3(0.030, 0.105, 0.270),
              .marks = false,
              .edgeLine = 0.05,
              .lineColor = Vec3(0.52, 0.72, 0.92),
              .ownJoints = true,
              .tileRoughness = 1,
              .wallRoughness = 1,
              .tileContrast = 0,
              .joints = 0.22,
              .floor = Vec3(0.010, 0.040, 0.120),
              .wall = Vec3(0.012, 0.048, 0.140),
              .slab = Vec3(0.012, 0.048, 0.140),
              .occlusion = false};
    case Look::kClay:
      return {.boxRoughness = 0.9,
              .ownColor = 0.30,
              .boxColor = Vec3(0.62, 0.56, 0.50),
              .marks = false,
              .tileRoughness = 0.95,
              .wallRoughness = 0.95,
              .tileContrast = 0.02,
              .joints = 0.18,
              .floor = Vec3(0.66, 0.63, 0.60),
              .wall = Vec3(0.70, 0.68, 0.66),
              .slab = Vec3(0.60, 0.60, 0.60)};
  }
  return {};
}

Materials materialsOf(const Stage& stage) {
  Materials materials = materialsOf(stage.picture.look);
  materials.marks = stage.scenery.marks.value_or(materials.marks);
  if (stage.scenery.gloss) {
    materials.boxRoughness = 1 - kSmoothest * *stage.scenery.gloss;
  }
  return materials;
}

}  // namespace careen
