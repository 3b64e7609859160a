#pragma once

#include <span>
#include <stop_token>

#include "sound/ringing.h"

namespace careen {

/// Adds the noise of what slides: white noise, the same in each film, whose power follows that of friction,
/// and whose highest tones go with the speed of slip, one asperity after the other. Friction is asked for at
/// moments of the run, and is linear in between. Samples as in addRinging.
void addSliding(std::span<double> samples, std::int64_t first, const Trajectory& run, const FilmClock& clock,
                const CameraPath& camera, Pitch pitch, const std::stop_token& stop = {});

}  // namespace careen
