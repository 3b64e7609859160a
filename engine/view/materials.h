#pragma once

#include "core/math/linear_algebra.h"
#include "stage/color.h"
#include "stage/picture_settings.h"
#include "stage/stage.h"

namespace careen {

/// Linear RGB: 1 is a fully lit white surface.
Vec3 linearFromSrgb(const Color& color);

/// Materials and tone mapping; together with Lighting they make up a look. Colours are linear.
struct Materials {
  double boxRoughness = 0.42;     ///< [1] 0 mirror, 1 fully rough; GGX uses its square
  double ownColor = 1;            ///< [1] weight of the box's own colour
  Vec3 boxColor = Vec3::Ones();   ///< colour for the remaining weight
  bool marks = true;              ///< pips and a frame on each face
  double edgeLine = 0;            ///< [1] width of lines along edges, relative to the face's smaller half
                                  ///< extent
  Vec3 lineColor = Vec3::Zero();  ///< of edge lines, and of joints if ownJoints
  bool ownJoints = false;
  double tileRoughness = 0.38;  ///< [1]
  double wallRoughness = 0.8;   ///< [1]
  double tileContrast = 0.10;   ///< [1] between neighbouring tiles
  double joints = 1;            ///< [1] visibility of joints
  Vec3 floor = Vec3(0.56, 0.51, 0.45);
  Vec3 wall = Vec3(0.72, 0.69, 0.64);
  Vec3 slab = Vec3(0.45, 0.50, 0.52);  ///< a sloping wall
  bool occlusion = true;               ///< boxes keep ambient light from surfaces and from each other
  double bounce = 0.6;    ///< [1] of an occluder's colour that comes back, times what it is lit with
  double corners = 0.30;  ///< [1] shade of a room's corners
  double shoulder = 0.8;  ///< [1] brightness where the tone curve's shoulder starts
  double dither = 1;      ///< [1] in 8-bit steps
};

Materials materialsOf(Look look);
/// The same with what the scene says of them.
Materials materialsOf(const Stage& stage);

}  // namespace careen
