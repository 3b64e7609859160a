#pragma once

#include <optional>
#include <utility>

#include "view/camera.h"

namespace careen {

/// Maps world points to picture coordinates [px], from the upper left corner, for overlays: points that are
/// not in front of the camera have none.
class Screen {
 public:
  /// Size in pixels.
  Screen(View view, int width, int height) : view_(std::move(view)), width_(width), height_(height) {}

  int width() const { return width_; }
  int height() const { return height_; }

  const Vec3& eye() const { return view_.eye; }

  std::optional<Vec2> at(const Vec3& point) const;
  /// [1] From the eye to what is seen there, per metre of its depth: at() backwards.
  Vec3 ray(const Vec2& pixel) const;
  /// The part of a line segment in front of the camera.
  std::optional<std::pair<Vec2, Vec2>> line(const Vec3& from, const Vec3& to) const;
  /// Size of a pixel at a point's depth, perpendicular to the line of sight.
  double metresPerPixel(const Vec3& point) const;
  /// Depth along the line of sight; smaller is nearer.
  double depth(const Vec3& point) const { return view_.clipFromWorld(point).w(); }

 private:
  Vec2 pixel(const Vec4& clip) const;

  View view_;
  int width_;
  int height_;
};

}  // namespace careen
