#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/draw/drawn_box.h"

namespace careen {

inline constexpr std::size_t kMostNear = 12;
inline constexpr std::size_t kMostFar = 32;

/// Boxes that keep ambient light from faces.
struct FaceNeighbors {
  struct Entry {
    std::size_t box = 0;
    double weight = 1;  ///< [1] falls to 0 before the box leaves the list
  };
  /// Of a face: boxes near it, whose shape counts, then those farther away, of which their size is enough. In
  /// between a box is in both lists, with weights that add up to 1.
  struct List {
    std::size_t begin = 0;
    std::size_t near = 0;
    std::size_t far = 0;
    float least = 0;  ///< [1] boxes that cover less of what the face sees do not count
  };
  std::vector<Entry> entries;
  std::vector<List> lists;  ///< of each face
  std::span<const Entry> near(std::size_t face) const {
    return std::span<const Entry>(entries).subspan(lists[face].begin, lists[face].near);
  }
  std::span<const Entry> far(std::size_t face) const {
    return std::span<const Entry>(entries).subspan(lists[face].begin + lists[face].near, lists[face].far);
  }
};

class KeptLists;

/// Of each face the boxes, kMostNear and kMostFar at most, that cover more than about `least` of what it
/// sees; only marked boxes occlude, and of several copies of a body only the one that covers most.
/// With the same result, what is kept is not looked for again.
FaceNeighbors neighborsOf(std::span<const DrawnBox> boxes, std::span<const DrawnFace> faces, double least,
                          const KeptLists* kept = nullptr);

/// [m²] Area of the largest silhouette of a box.
double largestSilhouette(const DrawnBox& box);

}  // namespace careen
