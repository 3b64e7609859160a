#include "render/overlay/box_cells.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "trajectory/trajectory.h"

namespace careen {
namespace {

// Depth at which a ray from `from` in direction `way`, both in the box's frame, enters the box.
std::optional<double> entry(const Vec3& from, const Vec3& way, const Vec3& halfExtents) {
  double enter = 0;
  double leave = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (way[axis] == 0) {
      if (std::abs(from[axis]) > halfExtents[axis]) {
        return std::nullopt;
      }
      continue;
    }
    const double side = way[axis] > 0 ? halfExtents[axis] : -halfExtents[axis];
    enter = std::max(enter, (-side - from[axis]) / way[axis]);
    leave = std::min(leave, (side - from[axis]) / way[axis]);
  }
  return enter < leave ? std::optional(enter) : std::nullopt;
}

int cellOf(double at, double side, int end) {
  return static_cast<int>(std::clamp(std::floor(at / side), -1.0, static_cast<double>(end)));
}

}  // namespace

BoxCells::BoxCells(const Screen& screen, std::span<const CellBox> boxes)
    : side_(static_cast<double>(screen.height()) / kRows),
      columns_(static_cast<int>(std::ceil(screen.width() / side_))),
      cells_(static_cast<std::size_t>(columns_) * kRows) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    cast(screen, boxes[i], static_cast<std::int32_t>(i));
  }
}

void BoxCells::cast(const Screen& screen, const CellBox& box, std::int32_t index) {
  const Mat3 bodyFromWorld = box.pose.worldFromBody.transpose();
  const Vec3 eye = bodyFromWorld * (screen.eye() - box.pose.position);
  if ((eye.cwiseAbs().array() < box.halfExtents.array()).all()) {
    return;
  }
  Vec2 min = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 max = -min;
  for (int i = 0; i < kCorners; ++i) {
    const std::optional<Vec2> at = screen.at(box.pose.worldPoint(corner(box.halfExtents, i)));
    if (!at) {  // it may be anywhere
      min = Vec2::Zero();
      max = Vec2(screen.width(), screen.height());
      break;
    }
    min = min.cwiseMin(*at);
    max = max.cwiseMax(*at);
  }
  const Vec3 first = bodyFromWorld * screen.ray(Vec2::Constant(0.5 * side_));
  const Vec3 right = bodyFromWorld * screen.ray(Vec2(1.5 * side_, 0.5 * side_)) - first;
  const Vec3 down = bodyFromWorld * screen.ray(Vec2(0.5 * side_, 1.5 * side_)) - first;
  for (int row = std::max(0, cellOf(min.y(), side_, kRows)); row <= cellOf(max.y(), side_, kRows - 1);
       ++row) {
    for (int column = std::max(0, cellOf(min.x(), side_, columns_));
         column <= cellOf(max.x(), side_, columns_ - 1); ++column) {
      const std::optional<double> depth = entry(eye, first + column * right + row * down, box.halfExtents);
      Seen& seen = cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                          static_cast<std::size_t>(column)];
      if (depth && (seen.box == kNoBox || *depth < seen.depth)) {
        seen = {.box = index, .depth = *depth};
      }
    }
  }
}

const BoxCells::Seen& BoxCells::cell(int column, int row) const {
  return cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                static_cast<std::size_t>(column)];
}

bool BoxCells::showOnly(std::int32_t box, const Vec2& min, const Vec2& max) const {
  const int left = cellOf(min.x(), side_, columns_);
  const int right = cellOf(max.x(), side_, columns_);
  const int top = cellOf(min.y(), side_, kRows);
  const int bottom = cellOf(max.y(), side_, kRows);
  if (left < 0 || top < 0 || right >= columns_ || bottom >= kRows) {
    return false;
  }
  for (int row = std::max(top - 1, 0); row <= std::min(bottom + 1, kRows - 1); ++row) {
    for (int column = std::max(left - 1, 0); column <= std::min(right + 1, columns_ - 1); ++column) {
      if (cell(column, row).box != box) {
        return false;
      }
    }
  }
  return true;
}

bool BoxCells::lineMeetsOnly(std::int32_t box, const Vec2& from, const Vec2& to) const {
  const int steps = static_cast<int>(std::ceil((to - from).norm() / (0.5 * side_)));
  for (int step = 0; step <= steps; ++step) {
    const Vec2 at = from + (steps > 0 ? static_cast<double>(step) / steps : 0.0) * (to - from);
    const int column = cellOf(at.x(), side_, columns_);
    const int row = cellOf(at.y(), side_, kRows);
    if (column < 0 || row < 0 || column >= columns_ || row >= kRows) {
      return false;
    }
    const std::int32_t seen = cell(column, row).box;
    if (seen != box && seen != kNoBox) {
      return false;
    }
  }
  return true;
}

}  // namespace careen
