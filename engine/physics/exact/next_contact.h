#pragma once

#include <optional>
#include <vector>

#include "physics/exact/event_queue.h"
#include "physics/exact/mover.h"
#include "physics/world/world.h"

namespace careen {

/// The first contact of a flying body with any wall, up to `end`.
std::optional<Event> firstWall(const Mover& body, const std::vector<Wall>& walls, const Instant& end);

/// The first contact of two bodies, the first of which moves, from the later of the starts of their motions
/// up to `until`.
std::optional<Event> firstMeeting(const Mover& body, const Mover& other, const Instant& until);

}  // namespace careen
