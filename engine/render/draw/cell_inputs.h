#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/draw/picture_cells.h"

namespace careen {

/// A number for what these numbers are, and for what `before` stands for: others have another one.
std::uint64_t digest(std::span<const float> numbers, std::uint64_t before = 0);

/// What each cell of a picture is drawn from, in order, as a number: cells of two pictures that are drawn
/// from the same have the same pixels. It consists of pieces, each with the records that GL is given of it.
class CellInputs {
 public:
  /// Size of what is drawn [px].
  CellInputs(View view, int width, int height);

  /// Adds a piece that may change pixels no farther than `reach` [px] from a convex outline [m]; which it is.
  std::size_t add(std::span<const Vec3> outline, double reach, std::uint64_t records);
  /// Adds one that changes pixels in the same cells as another piece.
  std::size_t addAt(std::size_t piece, std::uint64_t records);
  void addTo(int column, int row, std::uint64_t records);
  void addEverywhere(std::uint64_t records);

  PictureCells::Set changedSince(const CellInputs& before) const;
  bool isIn(std::size_t piece, const PictureCells::Set& cells) const;

 private:
  struct Place {
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  std::span<const std::uint16_t> cellsOf(const Place& place) const {
    return std::span(cells_).subspan(place.begin, place.end - place.begin);
  }

  View view_;
  int width_;
  int height_;
  std::array<std::uint64_t, PictureCells::kCount> inputs_{};
  std::vector<std::uint16_t> cells_;
  std::vector<Place> pieces_;  // in cells_
};

/// Which piece each vertex of a batch is part of.
class PieceVertices {
 public:
  /// Vertices up to this one are of that piece.
  void add(std::size_t piece, std::uint32_t endVertex) { ends_.push_back({piece, endVertex}); }
  /// Of triangles that come in the order of the pieces, those whose piece is in these cells.
  std::vector<std::uint32_t> trianglesIn(std::span<const std::uint32_t> triangles, const CellInputs& inputs,
                                         const PictureCells::Set& cells) const;

 private:
  struct End {
    std::size_t piece;
    std::uint32_t vertex;
  };
  std::vector<End> ends_;
};

}  // namespace careen
