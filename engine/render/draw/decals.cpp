#include "render/draw/decals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "render/draw/neighbors.h"

namespace careen {
namespace {

constexpr double kLeastFacing = 1e-3;  // sine of the light's height above a surface that it still lights
constexpr double kBeyond = 1.15;       // of the penumbra's width: it is a little wider outside the shadow

// The corners that the outline of a box has when seen along a direction, in order; by the signs of that
// direction in the box's frame.
constexpr std::array<std::array<int, 3>, 6> kSilhouette = {
    {{1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, 1, 1}, {-1, -1, 1}, {1, -1, 1}}};

// Clips only where it must.
std::vector<Vec3> clippedTo(std::vector<Vec3> outline, const Surface& surface) {
  const std::size_t count = surface.outline.size();
  for (std::size_t i = 0; i < count && outline.size() >= 3; ++i) {
    const Vec3& from = surface.outline[i];
    const Vec3 inward = surface.normal.cross(surface.outline[(i + 1) % count] - from);
    const double least = inward.dot(from);
    if (std::any_of(outline.begin(), outline.end(), [&](const Vec3& p) { return inward.dot(p) < least; })) {
      outline = clipped(outline, inward, least);
    }
  }
  return outline.size() >= 3 ? outline : std::vector<Vec3>();
}

// A convex outline in a plane, moved outward by `margin`: with mitres where it turns little, else with two
// corners.
std::vector<Vec3> widened(const std::vector<Vec3>& outline, const Vec3& normal, double margin) {
  std::vector<Vec3> result;
  const std::size_t count = outline.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3& at = outline[i];
    const Vec3 before = (at - outline[(i + count - 1) % count]).normalized();
    const Vec3 after = (outline[(i + 1) % count] - at).normalized();
    const Vec3 outBefore = before.cross(normal);
    const Vec3 outAfter = after.cross(normal);
    const double turn = outBefore.dot(outAfter);
    if (turn >= 0) {
      result.emplace_back(at + margin / (1 + turn) * (outBefore + outAfter));
    } else {
      result.emplace_back(at + margin * (outBefore + before));
      result.emplace_back(at + margin * (outAfter - after));
    }
  }
  return result;
}

double heightOver(const Surface& surface, const DrawnBox& box) {
  return surface.normal.dot(box.pose.position - surface.outline[0]);
}

// [m] A small piece of area A at a height z covers A z / (pi r^3) at most, seen from a distance r.
double reachOf(const DrawnBox& box, double height, double least) {
  return height > 0 ? std::cbrt(largestSilhouette(box) * height / (std::numbers::pi * least)) : 0;
}

// The part of a surface no farther than that from the box's centre.
std::vector<Vec3> outlineNear(const DrawnBox& box, const Surface& surface, double reach) {
  const double height = heightOver(surface, box);
  if (reach <= std::max(height, 0.0)) {
    return {};
  }
  const double side = std::max(std::sqrt(reach * reach - std::max(height, 0.0) * std::max(height, 0.0)),
                               box.halfExtents.norm());
  const Vec3 centre = box.pose.position - height * surface.normal;
  const Vec3 across = side * surface.across;
  const Vec3 along = side * surface.along;
  // An octagon about the circle.
  constexpr double kShort = 0.4142135623730951;  // tan(pi / 8)
  std::vector<Vec3> outline;
  for (const auto& [x, y] : {std::pair{1.0, -kShort},
                             {1.0, kShort},
                             {kShort, 1.0},
                             {-kShort, 1.0},
                             {-1.0, kShort},
                             {-1.0, -kShort},
                             {-kShort, -1.0},
                             {kShort, -1.0}}) {
    outline.emplace_back(centre + x * across + y * along);
  }
  return clippedTo(std::move(outline), surface);
}

}  // namespace

std::vector<Vec3> shadowOutline(const DrawnBox& box, const Surface& surface, const Vec3& towards,
                                double spread, double pixel) {
  const double facing = surface.normal.dot(towards);
  const Vec3 axes = box.pose.worldFromBody.transpose() * surface.normal;
  const double height = surface.normal.dot(box.pose.position - surface.outline[0]);
  const double top = height + axes.cwiseAbs().dot(box.halfExtents);
  if (facing < kLeastFacing || top <= 0) {
    return {};
  }
  const Vec3 light = box.pose.worldFromBody.transpose() * towards;
  std::vector<Vec3> outline;
  const double size = box.halfExtents.norm();
  for (const std::array<int, 3>& signs : kSilhouette) {
    Vec3 corner;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      corner[axis] = (light[axis] < 0 ? -1 : 1) * signs.at(k) * box.halfExtents[axis];
    }
    const Vec3 point = box.pose.worldPoint(corner);
    const double above = surface.normal.dot(point - surface.outline[0]);
    const Vec3 shade = point - above / facing * towards;
    if (outline.empty() ||
        ((shade - outline.back()).norm() > 1e-6 * size && (shade - outline.front()).norm() > 1e-6 * size)) {
      outline.push_back(shade);
    }
  }
  if (outline.size() < 3) {
    return {};
  }
  // Counterclockwise, seen from the side that the surface is seen from.
  Vec3 area = Vec3::Zero();
  for (std::size_t i = 2; i < outline.size(); ++i) {
    area += (outline[i - 1] - outline[0]).cross(outline[i] - outline[0]);
  }
  if (area.dot(surface.normal) < 0) {
    std::reverse(outline.begin(), outline.end());
  }
  // Across the light penumbrae are as wide as its distance makes them; along it the surface draws them out.
  // So they are round where that direction is shortened.
  const Vec3 level = towards - facing * surface.normal;
  const Vec3 along = level.norm() > 1e-9 ? Vec3(level.normalized()) : Vec3(Vec3::Zero());
  const auto stretch = [&](std::vector<Vec3>& points, double by) {
    for (Vec3& point : points) {
      point += (by - 1) * along.dot(point - surface.outline[0]) * along;
    }
  };
  stretch(outline, facing);
  outline = widened(outline, surface.normal, kBeyond * spread * top / facing + pixel);
  stretch(outline, 1 / facing);
  return clippedTo(std::move(outline), surface);
}

std::vector<Vec3> occlusionOutline(const DrawnBox& box, const Surface& surface, double least, double within) {
  const Vec3 axes = box.pose.worldFromBody.transpose() * surface.normal;
  const double extent = axes.cwiseAbs().dot(box.halfExtents);
  return outlineNear(box, surface, std::min(within, reachOf(box, heightOver(surface, box) + extent, least)));
}

std::vector<Vec3> farOcclusionOutline(const DrawnBox& box, const Surface& surface, double least) {
  return outlineNear(box, surface, reachOf(box, heightOver(surface, box), least));
}

void Decals::addFan(std::size_t corners) {
  for (std::uint32_t i = 2; i < corners; ++i) {
    triangles.insert(triangles.end(), {count, count + i - 1, count + i});
  }
  count += static_cast<std::uint32_t>(corners);
}

}  // namespace careen
