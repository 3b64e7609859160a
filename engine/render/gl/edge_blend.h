#pragma once

#include <cstdint>
#include <span>

namespace careen {

/// Antialiasing by where edges are, not by more samples (after E. Persson, "Geometric Post-process
/// Anti-Aliasing", GPU Pro 3, 2012). Whoever draws a pixel says in its alpha how far off the nearest edge of
/// the face drawn is; then every pixel that an edge crosses gets its share of the colour beyond, as exactly
/// as the edge is known, at the cost of a look at each alpha.
///
/// Alpha, 0 … 255: 255, no edge is near; 1 + 63 d + floor(63 t), an edge crosses the line to the next pixel
/// to the right, left, above or below, d = 0, 1, 2, 3, at t of the way, 0 <= t < 1; 0, nothing was drawn.
inline constexpr int kEdgeSteps = 63;
inline constexpr std::uint8_t kNoEdge = 255;

/// Four bytes a pixel, sRGB and alpha as above, rows from the bottom; blends in linear light, in place.
/// `scratch` has the same size.
void blendEdges(std::span<std::uint8_t> rgba, int width, int height, std::span<std::uint8_t> scratch);

}  // namespace careen
