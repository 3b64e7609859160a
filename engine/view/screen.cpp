#include "view/screen.h"

namespace careen {
namespace {

// Positive for points beyond the near plane.
double beyondNear(const Vec4& clip) { return clip.z() + clip.w(); }

}  // namespace

Vec2 Screen::pixel(const Vec4& clip) const {
  return {0.5 * width_ * (1 + clip.x() / clip.w()), 0.5 * height_ * (1 - clip.y() / clip.w())};
}

std::optional<Vec2> Screen::at(const Vec3& point) const {
  const Vec4 seen = view_.clipFromWorld(point);
  return beyondNear(seen) > 0 ? std::optional(pixel(seen)) : std::nullopt;
}

Vec3 Screen::ray(const Vec2& pixel) const {
  const Vec3 right = view_.clipFromOffset.block<1, 3>(0, 0).transpose();
  const Vec3 up = view_.clipFromOffset.block<1, 3>(1, 0).transpose();
  const Vec3 ahead = view_.clipFromOffset.block<1, 3>(3, 0).transpose();
  return ahead + (2 * pixel.x() / width_ - 1) / right.squaredNorm() * right +
         (1 - 2 * pixel.y() / height_) / up.squaredNorm() * up;
}

std::optional<std::pair<Vec2, Vec2>> Screen::line(const Vec3& from, const Vec3& to) const {
  Vec4 a = view_.clipFromWorld(from);
  Vec4 b = view_.clipFromWorld(to);
  const double aBeyond = beyondNear(a);
  const double bBeyond = beyondNear(b);
  if (!(aBeyond > 0) && !(bBeyond > 0)) {
    return std::nullopt;
  }
  if (!(aBeyond > 0)) {
    a += aBeyond / (aBeyond - bBeyond) * (b - a);
  } else if (!(bBeyond > 0)) {
    b += bBeyond / (bBeyond - aBeyond) * (a - b);
  }
  return std::pair(pixel(a), pixel(b));
}

double Screen::metresPerPixel(const Vec3& point) const {
  const double focal = view_.clipFromOffset.block<1, 3>(1, 0).norm();  // 1/tan(fov/2)
  return depth(point) / (0.5 * height_ * focal);
}

}  // namespace careen
