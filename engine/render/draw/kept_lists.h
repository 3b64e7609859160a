#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "render/draw/drawn_box.h"
#include "render/draw/neighbors.h"
#include "render/draw/shadow_pairs.h"

namespace careen {

/// What was found about the faces of the shot before, for those of the next one that see the same boxes.
class KeptLists {
 public:
  /// Compares the boxes and faces of a shot with those of the one before. Nothing is kept if the eye or the
  /// width of a pixel [rad] are others, boxes have copies, or no fewer of them have changed than have not.
  void begin(std::span<const DrawnBox> boxes, std::span<const DrawnFace> faces, const Vec3& eye,
             double pixelAngle);
  /// For the next shot: what was found of the boxes and faces of this one.
  void keep(FaceShadows shadows, FaceNeighbors neighbors);

  bool isEmpty() const { return faceBefore_.empty(); }
  /// Which face of the shot before a face is, if it and its box have not changed.
  std::optional<std::size_t> before(std::size_t face) const {
    return faceBefore_.empty() ? std::nullopt : faceBefore_[face];
  }
  /// Boxes that have changed, come or gone: as they were, and as they are.
  std::span<const DrawnBox> changed() const { return changed_; }
  /// Of a box that has not changed, which it was in the shot before: which it is now.
  std::size_t boxNow(std::size_t before) const { return boxNow_[before]; }
  const FaceShadows& shadowsBefore() const { return shadows_; }
  const FaceNeighbors& neighborsBefore() const { return neighbors_; }

 private:
  void compare(std::span<const DrawnBox> boxes, std::span<const DrawnFace> faces);

  Vec3 eye_ = Vec3::Zero();
  double pixelAngle_ = 0;
  std::vector<DrawnBox> boxes_;
  std::vector<DrawnFace> faces_;
  FaceShadows shadows_;
  FaceNeighbors neighbors_;
  std::vector<DrawnBox> changed_;
  std::vector<std::size_t> boxNow_;
  std::vector<std::optional<std::size_t>> faceBefore_;
};

}  // namespace careen
