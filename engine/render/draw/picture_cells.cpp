#include "render/draw/picture_cells.h"

#include <algorithm>
#include <cmath>

namespace careen {
namespace {

constexpr double kMargin = 0.1;  // [1] of a cell

}  // namespace

void PictureCells::mark(const std::vector<Vec3>& outline) {
  std::vector<Vec2> corners;  // in cells, from the lower left corner
  for (const Vec3& point : outline) {
    const Vec4 clip = view_.clipFromWorld(point);
    if (clip.w() <= 1e-9 * std::abs(clip.z())) {
      markAll();
      return;
    }
    corners.emplace_back((0.5 + 0.5 * clip.x() / clip.w()) * kColumns,
                         (0.5 + 0.5 * clip.y() / clip.w()) * kRows);
  }
  for (int row = 0; row < kRows; ++row) {
    double least = kColumns;
    double most = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2& from = corners[i];
      const Vec2& to = corners[(i + 1) % corners.size()];
      // The part of the edge in this row, with a margin of some pixels.
      const double low = std::max(std::min(from.y(), to.y()), row - kMargin);
      const double high = std::min(std::max(from.y(), to.y()), row + 1 + kMargin);
      if (low > high) {
        continue;
      }
      const double slope = to.y() == from.y() ? 0 : (to.x() - from.x()) / (to.y() - from.y());
      for (const double x : {to.y() == from.y() ? to.x() : from.x() + (low - from.y()) * slope,
                             from.x() + (high - from.y()) * slope}) {
        least = std::min(least, x);
        most = std::max(most, x);
      }
    }
    const int first = static_cast<int>(std::clamp<double>(std::floor(least - kMargin), 0, kColumns));
    const int end = static_cast<int>(std::clamp<double>(std::floor(most + kMargin) + 1, 0, kColumns));
    for (int column = first; column < end && least <= most; ++column) {
      marked_.at(static_cast<std::size_t>(row) * kColumns + static_cast<std::size_t>(column)) = true;
    }
  }
}

}  // namespace careen
