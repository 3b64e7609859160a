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

/// A part of a picture whose bottom row comes first [px].
struct PixelRectangle {
  int left = 0;
  int bottom = 0;
  int right = 0;  ///< the column after the last
  int top = 0;    ///< the row after the last
};

/// `drawn`: sRGB with alpha as above, bottom row first. What is blended of it in linear light goes to the
/// same places of `blended`, and nothing else there changes.
void blendEdges(std::span<const std::uint8_t> drawn, int width, int height, const PixelRectangle& within,
                std::span<std::uint8_t> blended);

}  // namespace careen
