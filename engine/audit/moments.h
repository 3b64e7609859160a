#pragma once

#include <cstddef>
#include <vector>

#include "trajectory/trajectory.h"

namespace careen {

/// The start and the end of [0, duration] and `count` moments between them, sorted: multiples of the golden
/// section, modulo 1. However many there are, they leave no large gap, and no step or frame of a method falls
/// on them.
std::vector<double> goldenMoments(double duration, std::size_t count);

/// The times of the rows of a run that comes from a table: those at which all movable bodies have one, or of
/// any if there are no such; the start, the end, and `count` evenly spread between them, or all if these are
/// not more.
std::vector<double> momentsOfRows(const Trajectory& run, std::size_t count);

}  // namespace careen
