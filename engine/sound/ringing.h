#pragma once

#include <span>
#include <vector>

#include "sound/strikes.h"

namespace careen {

/// What slow motion does to sound.
enum class Pitch {
  kSlows,  ///< it is slowed as well, and lower
  kStays   ///< it begins when it is seen to, and rings as it does in the scene
};

/// Adds the ringing of bodies that are struck to samples [Pa at the camera], the first of which is number
/// `first` of the film. A strike adds to each mode a decaying sine that begins at its moment, between samples
/// if need be, at 0: it does not jump. Modes above 20 kHz are left out, as heard in the film.
void addRinging(std::span<double> samples, std::int64_t first, const Trajectory& run, const FilmClock& clock,
                const std::vector<Strike>& strikes, Pitch pitch);

}  // namespace careen
