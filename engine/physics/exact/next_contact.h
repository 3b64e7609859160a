#pragma once

#include <optional>
#include <span>

#include "physics/exact/event_queue.h"
#include "physics/exact/mover.h"

namespace careen {

/// The first contact of a flying body with any wall, up to `end`, until which flights are foreseen.
std::optional<Event> firstWall(const Mover& body, std::span<const Mover> walls, const Instant& end);

/// The first contact of two bodies, the first of which moves, from the later of the starts of their motions
/// up to `until`, but for boxes to which its group sees. Flights are `foreseen` until then or later.
std::optional<Event> firstMeeting(const Mover& body, const Mover& other, const Instant& foreseen,
                                  const Instant& until);

}  // namespace careen
