#pragma once

#include <cstddef>

#include "study/plots.h"
#include "trajectory/trajectory.h"

namespace careen {

inline constexpr std::size_t kMostPlottedPairs = 12;
/// The forces with which what touches pushes each other over a run, every so long [s]: for each pair that
/// along the normals and friction, of all its points together. Of more pairs than can be told apart those
/// that push the most.
Plot forcePlot(const Trajectory& run, double every);

}  // namespace careen
