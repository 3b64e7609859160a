#include "truth/ray_cast.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "physics/world/body.h"
#include "view/camera.h"

namespace careen {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Pixels that a thing may cover.
PixelBox boundsOf(const PixelRays& rays, std::span<const Vec3> corners) {
  const PixelBox all{.left = 0, .top = 0, .right = rays.width() - 1, .bottom = rays.height() - 1};
  Vec2 least(kInfinity, kInfinity);
  Vec2 most(-kInfinity, -kInfinity);
  for (const Vec3& corner : corners) {
    const Vec3 pixel = rays.pixelOf(corner);
    if (!(pixel.z() > 0)) {
      return all;  // it reaches behind the eye
    }
    least = least.cwiseMin(pixel.head<2>());
    most = most.cwiseMax(pixel.head<2>());
  }
  // A pixel more on every side than rounding needs. Corners close to the eye may be anywhere.
  const auto within = [](double value, int size) {
    return static_cast<int>(std::clamp(value, -2.0, static_cast<double>(size) + 1));
  };
  return {.left = std::max(0, within(std::floor(least.x()) - 1, rays.width())),
          .top = std::max(0, within(std::floor(least.y()) - 1, rays.height())),
          .right = std::min(all.right, within(std::floor(most.x()) + 1, rays.width())),
          .bottom = std::min(all.bottom, within(std::floor(most.y()) + 1, rays.height()))};
}

class Caster {
 public:
  Caster(const PixelRays& rays, std::size_t boxes) : rays_(rays), boxes_(boxes) {
    const std::size_t pixels =
        static_cast<std::size_t>(rays.width()) * static_cast<std::size_t>(rays.height());
    picture_.depth.assign(pixels, kInfinity);
    picture_.instance.assign(pixels, 0);
    picture_.face.assign(pixels, 0);
    picture_.visible.assign(boxes, 0);
    picture_.alone.assign(boxes, 0);
    picture_.bounds.assign(boxes, {});
  }

  // The slab of each pair of faces holds a part of the ray; the box, what all three hold. The parts are those
  // of 1/depth times the ray in the box's frame, which is linear in the pixel's coordinates.
  void cast(const CastBox& box, std::size_t index, std::size_t part) {
    const Mat3 bodyFromWorld = box.pose.worldFromBody.transpose();
    const Vec3 eye = bodyFromWorld * (rays_.eye() - box.pose.position);
    if ((eye.cwiseAbs().array() <= box.halfExtents.array()).all()) {
      return;  // from inside
    }
    std::array<Vec3, kCorners> corners;
    for (int i = 0; i < kCorners; ++i) {
      corners[static_cast<std::size_t>(i)] = box.pose.worldPoint(corner(box.halfExtents, i));
    }
    const PixelBox bounds = boundsOf(rays_, corners);
    const Vec3 first = bodyFromWorld * rays_.first();
    const Vec3 right = bodyFromWorld * rays_.right();
    const Vec3 down = bodyFromWorld * rays_.down();
    const auto instance = static_cast<std::int32_t>(index + 1);
    for (int y = bounds.top; y <= bounds.bottom; ++y) {
      for (int x = bounds.left; x <= bounds.right; ++x) {
        const Vec3 along = first + static_cast<double>(x) * right + static_cast<double>(y) * down;
        double enters = 0;
        double leaves = kInfinity;
        int face = -1;
        for (int axis = 0; axis < 3; ++axis) {
          const double d = along[axis];
          const double half = box.halfExtents[axis];
          if (d == 0) {
            leaves = std::abs(eye[axis]) > half ? -1 : leaves;
            continue;
          }
          const double inverse = 1 / d;
          const double side = d > 0 ? -half : half;  // the face it meets first
          const double in = (side - eye[axis]) * inverse;
          const double out = (-side - eye[axis]) * inverse;
          if (in > enters) {
            enters = in;
            face = 2 * axis + (d > 0 ? 0 : 1);
          }
          leaves = std::min(leaves, out);
        }
        if (face >= 0 && enters <= leaves) {
          count(x, y, index);
          keep(x, y, enters, instance, static_cast<std::uint8_t>(6 * part + static_cast<unsigned>(face) + 1));
        }
      }
    }
  }

  // A pixel is inside if it is on the inner side of the planes through the eye and each edge. Two surfaces
  // that share an edge have the same plane there, so that no pixel is between them.
  void cast(const Surface& surface, std::size_t index) {
    if (surface.outline.empty()) {
      return;
    }
    const double distance = surface.normal.dot(rays_.eye() - surface.outline.front());
    if (!(distance > 0)) {
      return;
    }
    const PixelBox bounds = boundsOf(rays_, surface.outline);
    std::vector<Vec3> sides;  // inside where each of them, times the ray, is not below 0
    for (std::size_t i = 0; i < surface.outline.size(); ++i) {
      const Vec3 from = surface.outline[i] - rays_.eye();
      const Vec3 to = surface.outline[(i + 1) % surface.outline.size()] - rays_.eye();
      sides.emplace_back(to.cross(from));
    }
    const auto instance = static_cast<std::int32_t>(boxes_ + index + 1);
    for (int y = bounds.top; y <= bounds.bottom; ++y) {
      for (int x = bounds.left; x <= bounds.right; ++x) {
        const Vec3 along = rays_.offset(x, y);
        const double towards = -surface.normal.dot(along);
        if (towards > 0 &&
            std::all_of(sides.begin(), sides.end(), [&](const Vec3& side) { return side.dot(along) >= 0; })) {
          keep(x, y, distance / towards, instance, 0);
        }
      }
    }
  }

  CastPicture finish() {
    std::size_t place = 0;
    for (int y = 0; y < rays_.height(); ++y) {
      for (int x = 0; x < rays_.width(); ++x, ++place) {
        const auto instance = static_cast<std::size_t>(picture_.instance[place]);
        if (instance == 0) {
          picture_.depth[place] = 0;
        } else if (instance <= boxes_) {
          ++picture_.visible[instance - 1];
          picture_.bounds[instance - 1].add(x, y);
        }
      }
    }
    return std::move(picture_);
  }

  /// Of things of several boxes, casts those of one after the other.
  void cast(const CastBox& thing, std::size_t index) {
    if (thing.parts.empty()) {
      cast(thing, index, 0);
      return;
    }
    counted_.assign(picture_.depth.size(), 0);
    for (std::size_t part = 0; part < thing.parts.size(); ++part) {
      cast(thing.parts[part], index, part);
    }
    counted_.clear();
  }

 private:
  std::size_t placeOf(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(rays_.width()) +
           static_cast<std::size_t>(x);
  }

  // A pixel counts once, however many parts are there.
  void count(int x, int y, std::size_t index) {
    if (!counted_.empty() && std::exchange(counted_[placeOf(x, y)], 1) != 0) {
      return;
    }
    ++picture_.alone[index];
  }

  void keep(int x, int y, double depth, std::int32_t instance, std::uint8_t face) {
    const std::size_t place = placeOf(x, y);
    if (depth < picture_.depth[place]) {
      picture_.depth[place] = depth;
      picture_.instance[place] = instance;
      picture_.face[place] = face;
    }
  }

  const PixelRays& rays_;
  std::size_t boxes_;
  std::vector<char> counted_;  // pixels of a thing of several parts
  CastPicture picture_;
};

}  // namespace

void PixelBox::add(int x, int y) {
  if (right < left) {
    *this = {.left = x, .top = y, .right = x, .bottom = y};
    return;
  }
  left = std::min(left, x);
  right = std::max(right, x);
  top = std::min(top, y);
  bottom = std::max(bottom, y);
}

PixelRays::PixelRays(const Camera& camera, int width, int height)
    : width_(width),
      height_(height),
      eye_(camera.eye),
      worldFromCamera_(lookAt(camera.eye, camera.target, camera.up)),
      focalLength_(0.5 * height / slopeOfView(camera.fovDegrees)) {
  const Vec3 corner(-0.5 * (width - 1) / focalLength_, 0.5 * (height - 1) / focalLength_, -1);
  first_ = worldFromCamera_ * corner;
  right_ = worldFromCamera_.col(0) / focalLength_;
  down_ = -worldFromCamera_.col(1) / focalLength_;
}

Vec3 PixelRays::pixelOf(const Vec3& world) const {
  const Vec3 p = worldFromCamera_.transpose() * (world - eye_);
  if (!(p.z() < 0)) {
    return {0, 0, -p.z()};
  }
  return {0.5 * width_ + focalLength_ * (p.x() / -p.z()), 0.5 * height_ - focalLength_ * (p.y() / -p.z()),
          -p.z()};
}

CastPicture castRays(const PixelRays& rays, std::span<const CastBox> boxes,
                     std::span<const Surface> surfaces) {
  Caster caster(rays, boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    caster.cast(boxes[i], i);
  }
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    caster.cast(surfaces[i], i);
  }
  return caster.finish();
}

}  // namespace careen
