#pragma once

#include "physics/search/time_of_impact.h"

namespace careen {

/// First contact of a box that does not turn with the wall normal·x = offset, in closed form: its gap is a
/// parabola, d + v t + ½ a t². A gap within rounding at the start is zero, which is what makes it worth
/// having: a box that hops on a floor comes back after exactly 2v/|a|, however low the hop, where any search
/// for the root would be off by the rounding of the gap over v. The window must begin at 0.
FirstContact firstContactTranslating(const MovingBox& box, const Vec3& normal, double offset, double until);

}  // namespace careen
