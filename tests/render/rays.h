#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "image/srgb.h"
#include "render/stage.h"
#include "view/camera.h"
#include "view/scene_extent.h"
#include "view/surfaces.h"

namespace careen {

// Light by rays, to compare pictures with: closed intervals of boxes and planes, which share nothing with the
// renderer.

inline constexpr int kRays = 1024;  // a pixel

/// Boxes and surfaces at one moment, seen by a camera in a picture of some size.
class Rays {
 public:
  struct Hit {
    int thing = -1;  ///< box, or kSurfaces and more
    Vec3 point = Vec3::Zero();
    Vec3 normal = Vec3::UnitZ();
    bool isBox() const { return thing >= 0 && thing < kSurfaces; }
  };
  static constexpr int kSurfaces = 1'000'000;

  Rays(const RunSetup& setup, std::span<const Pose> poses, const Camera& camera)
      : poses_(poses.begin(), poses.end()),
        surfaces_(surfacesOf(setup.stage, extentOf(setup))),
        eye_(camera.eye),
        axes_(lookAt(camera.eye, camera.target, camera.up)),
        slope_(slopeOfView(camera.fovDegrees)),
        width_(setup.stage.picture.width),
        height_(setup.stage.picture.height) {
    for (const Body& body : setup.world.bodies) {
      halves_.push_back(body.halfExtents);
    }
  }

  int width() const { return width_; }
  int height() const { return height_; }

  /// What is seen at a point of the picture [px].
  Hit seenAt(double x, double y) const {
    const Vec3 along = directionAt(x, y);
    Hit hit;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
      const Surface& surface = surfaces_[i];
      const double away = surface.normal.dot(surface.outline[0] - eye_) / surface.normal.dot(along);
      if (surface.normal.dot(along) < 0 && away > 0 && away < nearest && isOn(surface, eye_ + away * along)) {
        nearest = away;
        hit = {
            .thing = kSurfaces + static_cast<int>(i), .point = eye_ + away * along, .normal = surface.normal};
      }
    }
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      Vec3 normal;
      const double at = enters(i, eye_, along, &normal);
      if (at > 0 && at < nearest) {
        nearest = at;
        hit = {.thing = static_cast<int>(i), .point = eye_ + at * along, .normal = normal};
      }
    }
    return hit;
  }

  /// What a pixel shows, if no edge is near it.
  std::optional<Hit> seenAlone(int x, int y) const {
    const Hit hit = seenAt(x + 0.5, y + 0.5);
    if (hit.thing < 0) {
      return std::nullopt;
    }
    for (const auto& [dx, dy] : {std::pair{2, 0}, {-2, 0}, {0, 2}, {0, -2}}) {
      const Hit other = seenAt(x + 0.5 + dx, y + 0.5 + dy);
      if (other.thing != hit.thing || other.normal.dot(hit.normal) < 0.999) {
        return std::nullopt;
      }
    }
    return hit;
  }

  /// The part of the light that comes to a pixel from a disc about `middle` whose edge has this slope, or
  /// without a slope from all of the half space: rays from all over the pixel.
  double freePart(int x, int y, const Hit& hit, const Vec3& middle, std::optional<double> spread) const {
    const std::vector<std::size_t> near = maybeHit(hit, middle, spread);
    if (near.empty()) {
      return 1;
    }
    const Vec3 across = middle.unitOrthogonal();
    const Vec3 above = middle.cross(across);
    int free = 0;
    for (int k = 0; k < kRays; ++k) {
      const auto part = [k](double step) { return step * k - std::floor(step * k); };  // evenly spread
      const Vec3 sight = directionAt(x + part(0.7548776662466927), y + part(0.5698402909980532));
      const Vec3 from = eye_ + hit.normal.dot(hit.point - eye_) / hit.normal.dot(sight) * sight;
      const double radius = std::sqrt((k + 0.5) / kRays);
      const Vec2 at = radius * Vec2(std::cos(2.399963229728653 * k), std::sin(2.399963229728653 * k));
      const double slope = spread ? *spread : 1;
      const double forward = spread ? 1 : std::sqrt(1 - at.squaredNorm());
      const Vec3 along = slope * (at.x() * across + at.y() * above) + forward * middle;
      free += std::none_of(near.begin(), near.end(),
                           [&](std::size_t i) { return enters(i, from, along, nullptr) >= 0; })
                  ? 1
                  : 0;
    }
    return static_cast<double>(free) / kRays;
  }

  /// Distance along a ray to where it enters a box, and through which side; negative where it does not.
  double enters(std::size_t box, const Vec3& from, const Vec3& along, Vec3* normal) const {
    double first = -std::numeric_limits<double>::infinity();
    double last = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
      const Vec3 axis = poses_[box].worldFromBody.col(k);
      const double at = axis.dot(from - poses_[box].position);
      const double slope = axis.dot(along);
      const double sign = slope < 0 ? -1 : 1;
      const double into = (-sign * halves_[box][k] - at) / slope;
      if (into > first) {
        first = into;
        if (normal != nullptr) {
          *normal = -sign * axis;
        }
      }
      last = std::min(last, (sign * halves_[box][k] - at) / slope);
    }
    return first < last && last > 0 ? std::max(first, 0.0) : -1;
  }

 private:
  Vec3 directionAt(double x, double y) const {
    return axes_ * Vec3((2 * x / width_ - 1) * slope_ * width_ / height_, (1 - 2 * y / height_) * slope_, -1);
  }

  static bool isOn(const Surface& surface, const Vec3& point) {
    for (std::size_t k = 0; k < surface.outline.size(); ++k) {
      const Vec3& from = surface.outline[k];
      const Vec3 edge = surface.outline[(k + 1) % surface.outline.size()] - from;
      if (surface.normal.dot(edge.cross(point - from)) < 0) {
        return false;
      }
    }
    return true;
  }

  // By bounding spheres.
  std::vector<std::size_t> maybeHit(const Hit& hit, const Vec3& middle, std::optional<double> spread) const {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      const Vec3 to = poses_[i].position - hit.point;
      const double radius = 1.2 * halves_[i].norm();
      const double forward = middle.dot(to);
      const bool isBehind = forward < -radius;
      const bool isBeside =
          spread && (to - forward * middle).norm() > radius + *spread * std::max(forward + radius, 0.0);
      if (static_cast<int>(i) != hit.thing && !isBehind && !isBeside) {
        found.push_back(i);
      }
    }
    return found;
  }

  std::vector<Pose> poses_;
  std::vector<Vec3> halves_;
  std::vector<Surface> surfaces_;
  Vec3 eye_;
  Mat3 axes_;
  double slope_;
  int width_;
  int height_;
};

/// Linear light of a pixel's green.
inline double lightAt(const Picture& picture, int x, int y) {
  return SrgbTables::get().linear(static_cast<std::uint8_t>(pixelAt(picture, x, y)[1])) / 65535.0;
}

/// A white scene without marks, patterns or gloss, whose pixels are the light that comes to them.
inline RenderOptions white(const Lighting& lighting) {
  RenderOptions options = lit(lighting);
  Materials& materials = *options.materials;
  materials.marks = false;
  materials.joints = 0;
  materials.tileContrast = 0;
  materials.corners = 0;
  materials.bounce = 0;
  materials.boxRoughness = materials.tileRoughness = materials.wallRoughness = 1;
  materials.floor = materials.wall = materials.slab = materials.boxColor = Vec3::Ones();
  materials.ownColor = 0;
  return options;
}

/// By light from one side only.
inline RenderOptions sunlit(const Vec3& towards, double spread) {
  Lighting lighting = evenLighting(Vec3::Constant(0.5));
  lighting.sky = lighting.ground = Vec3::Zero();
  lighting.light = Light{.towards = towards, .color = Vec3::Constant(0.8), .spread = spread};
  return white(lighting);
}

/// By light from all around, which boxes keep off.
inline RenderOptions skylit() {
  Lighting lighting = evenLighting(Vec3::Constant(0.5));
  lighting.sky = lighting.ground = Vec3::Constant(0.8);
  RenderOptions options = white(lighting);
  options.materials->occlusion = true;
  return options;
}

/// The same light, and nothing in its way.
inline RenderOptions unhindered(RenderOptions options) {
  options.materials->occlusion = false;
  if (options.lighting->light) {
    options.lighting->light->castsShadow = false;
  }
  return options;
}

}  // namespace careen
