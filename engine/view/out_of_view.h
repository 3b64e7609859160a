#pragma once

#include <cstddef>
#include <iosfwd>
#include <span>

#include "trajectory/trajectory.h"

namespace careen {

/// Boxes whose centres are outside the picture at some moment of a film.
struct OutOfView {
  std::size_t boxes = 0;
  std::size_t first = 0;  ///< the one that is outside first
  double moment = 0;      ///< [s] of the film, when it is
};

/// At these moments of the film [s], in order.
OutOfView outOfView(const Trajectory& run, std::span<const double> moments);
/// At 60 or more evenly spaced moments of all of the film.
OutOfView outOfView(const Trajectory& run);

/// A line for people; none where nothing is left out.
void print(std::ostream& out, const OutOfView& found, const Trajectory& run);

}  // namespace careen
