#pragma once

#include <optional>

#include "physics/start/overlap.h"
#include "scene/scene.h"

namespace careen {

/// Whether boxes may overlap, or be behind walls, at the start of a scene.
enum class Starts { kApart, kMayOverlap };

/// As tests for overlap take it.
PlacedBox placedBox(const SceneBox& box);

/// The first two overlapping boxes in the scene's order, if its method lets boxes collide.
std::optional<Overlap> findOverlap(const Scene& scene);

/// InputError if two boxes overlap and the scene's method lets boxes collide: for callers that replace the
/// method with which the scene was read.
void checkApart(const Scene& scene);

/// Moves the scene's boxes out of walls and, if its method lets boxes collide, out of each other; see
/// moveApart of the engine. InputError if there is no room, or if a box of a joint would have to be moved.
Parted moveApart(Scene& scene);

}  // namespace careen
