#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math/linear_algebra.h"
#include "core/math/pose.h"
#include "view/screen.h"

namespace careen {

/// A box with its middle at the pose's origin.
struct CellBox {
  Pose pose;
  Vec3 halfExtents = Vec3::Zero();  ///< [m]
};

/// Which box each small square of a picture shows, by a ray through its middle. A box from inside is not
/// seen. Walls are not asked: what is in front of a wall is not hidden by it, and from behind it is not
/// drawn.
class BoxCells {
 public:
  static constexpr int kRows = 360;  ///< squares from top to bottom, for every size of picture
  static constexpr std::int32_t kNoBox = -1;

  BoxCells(const Screen& screen, std::span<const CellBox> boxes);

  /// Whether this box, and nothing else, is seen at a point of the picture [px] and within a square's side of
  /// it, or throughout a rectangle and there; of kNoBox, whether no box is seen there. False outside.
  bool showOnly(std::int32_t box, const Vec2& point) const { return showOnly(box, point, point); }
  bool showOnly(std::int32_t box, const Vec2& min, const Vec2& max) const;
  /// Whether along a line no box is seen but this.
  bool lineMeetsOnly(std::int32_t box, const Vec2& from, const Vec2& to) const;

 private:
  struct Seen {
    std::int32_t box = kNoBox;
    double depth = 0;  // [m]
  };
  void cast(const Screen& screen, const CellBox& box, std::int32_t index);
  const Seen& cell(int column, int row) const;

  double side_;  // [px]
  int columns_;
  std::vector<Seen> cells_;
};

}  // namespace careen
