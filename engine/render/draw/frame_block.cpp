#include "render/draw/frame_block.h"

#include <algorithm>
#include <cmath>

namespace careen {

double leastOcclusion(std::size_t boxes) {
  return std::clamp(0.004 * std::sqrt(static_cast<double>(boxes) / 100), 0.004, 0.022);
}

double leastOnBoxes(std::size_t boxes) { return std::min(leastOcclusion(boxes), 0.008); }

FrameBlock blockOf(const DrawnLook& look) {
  const Lighting& lighting = look.lighting;
  const Materials& materials = look.materials;
  FrameBlock block;
  block.sky = floats(lighting.sky);
  block.ground = floats(lighting.ground);
  block.backgroundTop = floats(lighting.backgroundTop);
  block.backgroundBottom = floats(lighting.backgroundBottom);
  block.finish =
      floats(Vec3(materials.shoulder, look.wantsEdges ? 1 : 0, materials.dither), leastOnBoxes(look.boxes));
  block.boxLook =
      floats(Vec3(materials.boxRoughness, materials.marks ? 1 : 0, materials.ownColor), materials.edgeLine);
  block.material = floats(materials.boxColor);
  block.lines = floats(materials.lineColor, materials.ownJoints ? 1 : 0);
  block.surfaceLook = floats(Vec3(materials.tileRoughness, materials.wallRoughness, materials.tileContrast),
                             materials.joints);
  block.occlusion = floats(Vec3(look.parts.has(LightPart::kOcclusion) ? materials.corners : 0,
                                leastOcclusion(look.boxes), 1.0 / look.width),
                           1.0 / look.height);
  if (lighting.light) {
    block.towardsLight = floats(lighting.light->towards.normalized(), kCurveOfDisc * lighting.light->spread);
    block.lightColor = floats(lighting.light->color);
  }
  return block;
}

}  // namespace careen
