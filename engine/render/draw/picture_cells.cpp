#include "render/draw/picture_cells.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "view/surfaces.h"

namespace careen {
namespace {

constexpr double kMargin = 0.1;  // [1] of a cell: some pixels

}  // namespace

PixelRectangle PictureCells::pixelsOf(int column, int endColumn, int row, int endRow, int width, int height) {
  return {.left = width * column / kColumns,
          .bottom = height * row / kRows,
          .right = width * endColumn / kColumns,
          .top = height * endRow / kRows};
}

void PictureCells::append(const View& view, std::span<const Vec3> outline, const Vec2& margin,
                          std::vector<std::uint16_t>& cells) {
  std::vector<Vec2> corners;  // in cells, from the lower left corner
  double low = kRows;
  double high = 0;
  for (const Vec3& point : outline) {
    const Vec4 clip = view.clipFromWorld(point);
    if (clip.w() <= 1e-9 * std::abs(clip.z())) {
      const std::size_t before = cells.size();
      cells.resize(before + kCount);
      std::iota(cells.begin() + static_cast<std::ptrdiff_t>(before), cells.end(), std::uint16_t{0});
      return;
    }
    corners.emplace_back((0.5 + 0.5 * clip.x() / clip.w()) * kColumns,
                         (0.5 + 0.5 * clip.y() / clip.w()) * kRows);
    low = std::min(low, corners.back().y());
    high = std::max(high, corners.back().y());
  }
  const int last = static_cast<int>(std::clamp<double>(std::floor(high + margin.y()), -1, kRows - 1));
  for (int row = static_cast<int>(std::clamp<double>(std::floor(low - margin.y()), 0, kRows)); row <= last;
       ++row) {
    double least = kColumns;
    double most = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2& from = corners[i];
      const Vec2& to = corners[(i + 1) % corners.size()];
      // The part of the edge in this row, with the margin.
      const double bottom = std::max(std::min(from.y(), to.y()), row - margin.y());
      const double top = std::min(std::max(from.y(), to.y()), row + 1 + margin.y());
      if (bottom > top) {
        continue;
      }
      const double slope = to.y() == from.y() ? 0 : (to.x() - from.x()) / (to.y() - from.y());
      for (const double x : {to.y() == from.y() ? to.x() : from.x() + (bottom - from.y()) * slope,
                             from.x() + (top - from.y()) * slope}) {
        least = std::min(least, x);
        most = std::max(most, x);
      }
    }
    const int first = static_cast<int>(std::clamp<double>(std::floor(least - margin.x()), 0, kColumns));
    const int end = static_cast<int>(std::clamp<double>(std::floor(most + margin.x()) + 1, 0, kColumns));
    for (int column = first; column < end && least <= most; ++column) {
      cells.push_back(static_cast<std::uint16_t>(indexOf(column, row)));
    }
  }
}

PictureCells::Set PictureCells::filledBy(const View& view, std::vector<Vec3> outline, int width, int height) {
  for (const double end : {1.0, -1.0}) {  // what is nearer or farther than GL draws is cut off
    const Vec4 plane = (view.clipFromOffset.row(3) + end * view.clipFromOffset.row(2)).transpose();
    const Vec3 inward = plane.head<3>();
    outline = clipped(outline, inward, inward.dot(view.eye) - plane.w());
  }
  std::vector<Vec2> corners;  // [px] from the lower left corner
  double area = 0;
  for (const Vec3& point : outline) {
    const Vec4 clip = view.clipFromWorld(point);
    corners.emplace_back((0.5 + 0.5 * clip.x() / clip.w()) * width,
                         (0.5 + 0.5 * clip.y() / clip.w()) * height);
  }
  const auto cross = [](const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); };
  for (std::size_t i = 0; i < corners.size(); ++i) {
    area += cross(corners[i], corners[(i + 1) % corners.size()]);
  }
  Set filled;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const PixelRectangle at = pixelsOf(column, column + 1, row, row + 1, width, height);
      const Vec2 middle(0.5 * (at.left + at.right), 0.5 * (at.bottom + at.top));
      const Vec2 half(0.5 * (at.right - at.left) + 1, 0.5 * (at.top - at.bottom) + 1);
      bool isInside = !corners.empty();
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec2 along = corners[(i + 1) % corners.size()] - corners[i];
        const double inside = (area > 0 ? 1 : -1) * cross(along, middle - corners[i]);
        isInside = isInside && inside > std::abs(along.y()) * half.x() + std::abs(along.x()) * half.y();
      }
      filled[indexOf(column, row)] = isInside;
    }
  }
  return filled;
}

void PictureCells::mark(const std::vector<Vec3>& outline) {
  std::vector<std::uint16_t> cells;
  append(view_, outline, Vec2(kMargin, kMargin), cells);
  for (const std::uint16_t cell : cells) {
    marked_.set(cell);
  }
}

std::vector<PixelRectangle> pixelsOf(const PictureCells::Set& cells, int width, int height) {
  std::vector<PixelRectangle> parts;
  forRectangles([&](int column, int row) { return cells[PictureCells::indexOf(column, row)] ? 1 : 0; },
                [&](int isIn, int column, int endColumn, int row, int endRow) {
                  if (isIn != 0) {
                    parts.push_back(PictureCells::pixelsOf(column, endColumn, row, endRow, width, height));
                  }
                });
  return parts;
}

}  // namespace careen
