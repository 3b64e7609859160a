#pragma once

#include "trajectory/archive.h"
#include "trajectory/trajectory.h"
#include "trajectory/trajectory_file.h"

namespace careen {

/// Format version 3, which stored of world and stage only names and masses: the scene gives the rest.

/// Reads its record up to the state hash. InputError without `setupOf`, or if bodies or walls are others than
/// the scene's.
void readFormat3(ArchiveReader& reader, const SetupReader& setupOf, Trajectory& run);

/// Initial states from the tracks, because boxes that overlapped in the scene were moved apart. InputError
/// (checkMotions) if a track has no state.
void startWhereTracksDo(Trajectory& run);

}  // namespace careen
