#pragma once

#include <optional>

#include "physics/start/overlap.h"
#include "scene/scene.h"

namespace careen {

/// Whether boxes may share space, or stand behind walls, when a scene starts.
enum class Starts { kApart, kMayOverlap };

/// The first two boxes in the scene's order that overlap, if its method lets boxes meet.
std::optional<Overlap> findOverlap(const Scene& scene);

/// InputError if two boxes overlap that the scene's method lets meet: for who puts another method in place of
/// the one that the scene was read with.
void checkApart(const Scene& scene);

/// Moves the scene's boxes out of walls and, if its method lets boxes meet, out of each other; see the
/// engine's moveApart. InputError if there is no room.
Parted moveApart(Scene& scene);

}  // namespace careen
