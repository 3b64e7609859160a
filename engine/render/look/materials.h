#pragma once

#include "core/math/linear_algebra.h"
#include "stage/picture_settings.h"

namespace careen {

/// What things are made of and how the picture is finished: a look, with Lighting. Colours are linear.
struct Materials {
  double boxRoughness = 0.42;     ///< [1] 0 a mirror, 1 chalk; as GGX has it, squared
  double ownColor = 1;            ///< [1] part of a box's colour that is its own
  Vec3 boxColor = Vec3::Ones();   ///< the rest of it
  bool marks = true;              ///< pips and a frame on each face
  double edgeLine = 0;            ///< [1] of a face's smaller half extent: width of lines along edges
  Vec3 lineColor = Vec3::Zero();  ///< of these, and of joints where they have a colour of their own
  bool ownJoints = false;
  double tileRoughness = 0.38;  ///< [1]
  double wallRoughness = 0.8;   ///< [1]
  double tileContrast = 0.10;   ///< [1] of a tile to its neighbours
  double joints = 1;            ///< [1] how far they are seen
  Vec3 floor = Vec3(0.56, 0.51, 0.45);
  Vec3 wall = Vec3(0.72, 0.69, 0.64);
  Vec3 slab = Vec3(0.45, 0.50, 0.52);  ///< a sloping wall
  double contactShade = 0.7;  ///< [1] of the light that a box keeps off where it touches; 0: no pass for it
  double shoulder = 0.8;      ///< [1] brightness from which on the tone curve gives in
  double dither = 1;          ///< [1] steps of 8 bits
};

Materials materialsOf(Look look);

}  // namespace careen
