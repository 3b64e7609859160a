#pragma once

#include <cstddef>
#include <string>

#include "trajectory/exporter.h"

namespace careen {

inline constexpr double kLeastGlbError = 1e-7;  ///< [m, rad] rounding to single precision
inline constexpr double kMostGlbError = 1;

struct GlbFile {
  std::string bytes;
  std::size_t keys = 0;      ///< of all channels
  double positionError = 0;  ///< [m] the largest found
  double attitudeError = 0;  ///< [rad] likewise
};

/// A film of a run as a binary glTF 2.0 file (GLB): boxes, floor and walls, springs as lines, the film's
/// camera and an animation. Its time is the film's: at t [s] it shows the run at the scene time that the film
/// shows. Nodes have the boxes' names, and their translation and rotation are the boxes' poses; one node
/// above them turns z up into glTF's y up. Keys are linear, as few as hold the motion within the bound
/// (exchange/animation_keys.h); what was found stands in asset.extras. The field of view is that of the
/// film's start: glTF has no animation of it. InputError as checkGlbError(), or if the
/// file would be larger than 2 GiB.
GlbFile encodeGlb(const Trajectory& run, const ExportSettings& settings = {});

/// InputError if `within` is not from kLeastGlbError to kMostGlbError.
void checkGlbError(double within);

}  // namespace careen
