#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "view/camera.h"

namespace careen {

/// The picture in coarse cells, some of them marked: so that what only a part of the picture needs is drawn
/// only there.
class PictureCells {
 public:
  static constexpr int kColumns = 40;
  static constexpr int kRows = 24;

  explicit PictureCells(View view) : view_(std::move(view)) {}
  /// Marks all cells that a convex outline [m] may reach in the picture.
  void mark(const std::vector<Vec3>& outline);
  void markAll() { marked_.fill(true); }
  bool isMarked(int column, int row) const {
    return marked_.at(static_cast<std::size_t>(row) * kColumns + static_cast<std::size_t>(column));
  }

 private:
  View view_;
  std::array<bool, static_cast<std::size_t>(kColumns) * kRows> marked_{};  // rows from below
};

}  // namespace careen
