#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "render/gl/edge_blend.h"
#include "view/camera.h"

namespace careen {

/// The picture in coarse cells, some of them marked: so that what only a part of the picture needs is drawn
/// only there.
class PictureCells {
 public:
  static constexpr int kColumns = 40;
  static constexpr int kRows = 24;
  static constexpr std::size_t kCount = static_cast<std::size_t>(kColumns) * kRows;
  using Set = std::bitset<kCount>;
  /// Of a cell, rows from below.
  static std::size_t indexOf(int column, int row) {
    return static_cast<std::size_t>(row) * kColumns + static_cast<std::size_t>(column);
  }
  /// Of cells from these to those before the end, in a picture of this size [px].
  static PixelRectangle pixelsOf(int column, int endColumn, int row, int endRow, int width, int height);
  /// Appends all cells that a convex outline [m], with a margin [cells], may reach in the picture.
  static void append(const View& view, std::span<const Vec3> outline, const Vec2& margin,
                     std::vector<std::uint16_t>& cells);

  /// Cells that a convex outline [m] fills, be it a pixel smaller, in a picture of this size [px].
  static Set filledBy(const View& view, std::vector<Vec3> outline, int width, int height);

  explicit PictureCells(View view) : view_(std::move(view)) {}
  /// Marks all cells that a convex outline [m] may reach in the picture.
  void mark(const std::vector<Vec3>& outline);
  void markAll() { marked_.set(); }
  bool isMarked(int column, int row) const { return marked_[indexOf(column, row)]; }

 private:
  View view_;
  Set marked_;
};

/// Calls with the value of a rectangle of cells, its first column and the one after its last, and likewise
/// its rows: whole rows that have the same values in all columns are together.
template <class ValueOf, class Do>
void forRectangles(const ValueOf& valueOf, const Do& doWith) {
  using Row = std::array<int, PictureCells::kColumns>;
  const auto rowOf = [&](int row) {
    Row values{};
    for (int column = 0; column < PictureCells::kColumns; ++column) {
      values.at(static_cast<std::size_t>(column)) = valueOf(column, row);
    }
    return values;
  };
  for (int row = 0; row < PictureCells::kRows;) {
    const Row values = rowOf(row);
    int endRow = row + 1;
    while (endRow < PictureCells::kRows && rowOf(endRow) == values) {
      ++endRow;
    }
    for (int column = 0; column < PictureCells::kColumns;) {
      const int value = values.at(static_cast<std::size_t>(column));
      int end = column;
      while (end < PictureCells::kColumns && values.at(static_cast<std::size_t>(end)) == value) {
        ++end;
      }
      doWith(value, column, end, row, endRow);
      column = end;
    }
    row = endRow;
  }
}

/// [px] These cells of a picture of this size.
std::vector<PixelRectangle> pixelsOf(const PictureCells::Set& cells, int width, int height);

}  // namespace careen
