#pragma once

#include <cstdint>
#include <span>

namespace careen {

/// Antialiasing by edge distance instead of more samples (after E. Persson, "Geometric Post-process
/// Anti-Aliasing", GPU Pro 3, 2012). The shader writes the distance to the nearest edge of its face to alpha;
/// each pixel that an edge crosses is then blended with its neighbour by coverage, as exactly as the edge is
/// known, at the cost of reading each alpha once.
///
/// Alpha values, 0 … 255. 255: no edge near; 1 + 63 d + floor(63 t): an edge crosses the line to the next
/// pixel to the right, left, above or below (d = 0, 1, 2, 3) at fraction t, 0 <= t < 1; 0: nothing was drawn.
inline constexpr int kEdgeSteps = 63;
inline constexpr std::uint8_t kNoEdge = 255;

/// `rgba`: sRGB with alpha as above, bottom row first; blended in linear light, in place. `scratch` has the
/// same size.
void blendEdges(std::span<std::uint8_t> rgba, int width, int height, std::span<std::uint8_t> scratch);

}  // namespace careen
