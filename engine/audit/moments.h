#pragma once

#include <cstddef>
#include <vector>

namespace careen {

/// The start and the end of [0, duration] and `count` moments between them, sorted: multiples of the golden
/// section, modulo 1. However many there are, they leave no large gap, and no step or frame of a method falls
/// on them.
std::vector<double> goldenMoments(double duration, std::size_t count);

}  // namespace careen
