#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/draw/drawn_box.h"

namespace careen {

inline constexpr std::size_t kMostNeighbors = 8;

/// Boxes that keep ambient light from faces.
struct Neighbors {
  struct Entry {
    std::size_t box = 0;
    double weight = 1;  ///< [1] falls to 0 before the box leaves the list
  };
  std::vector<Entry> entries;
  std::vector<std::size_t> begins;  ///< of each face's entries, and the end
  std::span<const Entry> of(std::size_t face) const {
    return std::span<const Entry>(entries).subspan(begins[face], begins[face + 1] - begins[face]);
  }
};

/// Of each face the boxes, kMostNeighbors at most, that cover more than about `least` of what it sees; only
/// marked boxes occlude, and of several copies of a body only the one that covers most.
Neighbors neighborsOf(std::span<const DrawnBox> boxes, std::span<const DrawnFace> faces, double least);

/// [m²] Area of the largest silhouette of a box.
double largestSilhouette(const DrawnBox& box);

}  // namespace careen
