#pragma once

#include <vector>

#include "physics/exact/bodies.h"
#include "physics/exact/crowd_group.h"

namespace careen {

// What a crowd is about to meet. Bodies are given by rank.

enum class Outsiders {
  kAll,
  kInNoGroup,  ///< of the others it is known where they are now, not where they were
};
/// Bodies that are no members and may get into that space within that time [s] from `time` on.
std::vector<int> outsidersIn(const Bodies& bodies, const CrowdGroup& group, const Crowd::Extent& extent,
                             const Instant& time, double length, Outsiders which);
/// [1] Steps in which a crowd looks ahead for others, no larger, which it takes in before they meet. To
/// become one early costs nothing, but to meet a larger one within its step costs that step of all its
/// members.
inline constexpr double kStepsAhead = 4;
/// Whether a member meets it within the next step if nothing pushes it; of a body at rest, whether one is
/// near; of a member of a crowd that is not larger, whether one is near within kStepsAhead.
bool meetsNext(const Bodies& bodies, const CrowdGroup& group, int rank, const Instant& time, double length);
/// Whether a member met it in the step that it has taken from `time` on.
bool wasMet(const Bodies& bodies, const CrowdGroup& group, int rank, const Instant& time);
/// Who may meet a member in the step that it has taken, perhaps another way than it was going.
std::vector<int> nearStep(const Bodies& bodies, const CrowdGroup& group);

/// Whether it came to rest after that moment; and whether it has been in Flight, with no body on a spring,
/// since then or longer.
bool restsOnlySince(const Mover& body, const Instant& time);
bool fliesSince(const Bodies& bodies, const Mover& body, const Instant& time);

}  // namespace careen
