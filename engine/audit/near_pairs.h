#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "core/math/linear_algebra.h"

namespace careen {

/// A ball around a body.
struct Ball {
  Vec3 center;
  double radius = 0;  ///< [m]
};

/// Pairs of balls that may overlap, each once, the smaller index first: a sweep along the axis on which the
/// centres spread most. Balls that are not finite are left out.
std::vector<std::pair<std::size_t, std::size_t>> nearPairs(std::span<const Ball> balls);

}  // namespace careen
