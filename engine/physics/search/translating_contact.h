#pragma once

#include "physics/search/time_of_impact.h"

namespace careen {

/// First contact of a box that does not rotate with the wall normal·x = offset, in closed form: its gap is a
/// parabola, d + v t + ½ a t². A gap within rounding at the start counts as zero, which is the point of this
/// function: a box hopping on a floor returns after exactly 2v/|a|, however low the hop, where any root
/// search would be off by the rounding of the gap over v. The window must begin at 0.
FirstContact firstContactTranslating(const MovingBox& box, const Vec3& normal, double offset, double until);

}  // namespace careen
