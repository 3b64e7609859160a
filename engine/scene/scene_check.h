#pragma once

#include <cstddef>
#include <optional>

#include "scene/json_tree.h"
#include "scene/scene.h"

namespace careen {

/// Second half of reading a scene: what its values say about each other. Finds the boxes that springs name;
/// names are unique among boxes and walls, room walls included; the camera looks somewhere; every box starts
/// on the free side of every wall and, where boxes meet, outside every other, but for kGapAllowance.
/// InputError at the place in `tree`, which the scene was read from.
void checkScene(const JsonTree& tree, Scene& scene);

/// Two boxes that share space, and how deep [m].
struct Overlap {
  std::size_t first = 0;
  std::size_t second = 0;
  double depth = 0;
};
/// The first two in the scene's order, two fixed ones excepted, that overlap by more than kGapAllowance.
std::optional<Overlap> findOverlap(const Scene& scene);

/// How deep in a wall a box may start, for rounding's sake: this much of the lengths its gap is the
/// difference of.
inline constexpr double kGapAllowance = 1e-12;

}  // namespace careen
