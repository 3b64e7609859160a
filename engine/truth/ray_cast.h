#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/linear_algebra.h"
#include "core/math/pose.h"
#include "stage/camera.h"
#include "view/surfaces.h"

namespace careen {

/// The ray of each pixel's centre, with depth 1 along the line of sight: offset(x, y) from the eye, for pixel
/// x from the left and y from the top of a picture of this size. Its projection is that of the pictures.
class PixelRays {
 public:
  PixelRays(const Camera& camera, int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  const Vec3& eye() const { return eye_; }
  /// [1] Of pixel (0, 0), and its change from one pixel to the right, and to the one below.
  const Vec3& first() const { return first_; }
  const Vec3& right() const { return right_; }
  const Vec3& down() const { return down_; }
  Vec3 offset(double x, double y) const { return first_ + x * right_ + y * down_; }
  const Mat3& worldFromCamera() const { return worldFromCamera_; }
  /// [px] Focal lengths of the camera's matrix; its principal point is the picture's middle.
  double focalLength() const { return focalLength_; }
  /// [px] Coordinates of a world point, as View::pixelFromWorld has them (a pixel's centre is at ½), and its
  /// depth [m] in z. Not a point of the picture if the depth is not above 0: both coordinates are then 0.
  Vec3 pixelOf(const Vec3& world) const;

 private:
  int width_;
  int height_;
  Vec3 eye_;
  Mat3 worldFromCamera_;
  double focalLength_;
  Vec3 first_;
  Vec3 right_;
  Vec3 down_;
};

/// A box to be hit, or several that are one thing.
struct CastBox {
  Pose pose;
  Vec3 halfExtents = Vec3::Zero();  ///< [m]
  std::vector<CastBox> parts = {};  ///< in the world too; none: the box itself
};

/// Rectangle of pixels, its ends included; empty if right < left.
struct PixelBox {
  int left = 0;
  int top = 0;
  int right = -1;
  int bottom = -1;

  void add(int x, int y);
  friend bool operator==(const PixelBox&, const PixelBox&) = default;
};

/// What the pixels show: arrays of height × width, in rows from the top.
struct CastPicture {
  std::vector<double> depth;  ///< [m] along the line of sight; 0 where nothing is hit
  std::vector<std::int32_t>
      instance;                    ///< 0 nothing; box i is i + 1; surface j is the number of boxes + j + 1
  std::vector<std::uint8_t> face;  ///< 0 no box; 1 … 6 the face −x, +x, −y, +y, −z, +z of a box; of its
                                   ///< part k, 6 k more
  std::vector<std::int64_t> visible;  ///< pixels of each box
  std::vector<std::int64_t> alone;    ///< pixels it would have if nothing were before it
  std::vector<PixelBox> bounds;       ///< of its visible pixels
};

/// Rays against boxes and surfaces in closed form, double precision, at the centres of pixels. A box from
/// inside is not seen, nor is a surface from behind. The same bits everywhere.
CastPicture castRays(const PixelRays& rays, std::span<const CastBox> boxes,
                     std::span<const Surface> surfaces);

}  // namespace careen
