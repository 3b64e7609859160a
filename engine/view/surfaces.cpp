#include "view/surfaces.h"

#include <cmath>
#include <cstddef>
#include <tuple>

namespace careen {
namespace {

// Side 0…5 of a room, in the order of kRoomSides.
Surface roomSide(const RoomShape& room, std::size_t side, const Materials& materials) {
  const auto axis = static_cast<Eigen::Index>(side / 2);
  const bool isMax = side % 2 == 1;
  Surface surface;
  surface.normal = Vec3::Unit(axis) * (isMax ? -1 : 1);
  surface.along = axis == 2 ? Vec3::UnitY() : Vec3::UnitZ();
  surface.across = surface.along.cross(surface.normal);
  const Vec3 extent = room.max - room.min;
  // The corner of the side from which both directions point into it.
  const Vec3 sum = surface.across + surface.along;
  for (Eigen::Index k = 0; k < 3; ++k) {
    surface.origin[k] = (k == axis ? isMax : sum[k] < 0) ? room.max[k] : room.min[k];
  }
  const double width = std::abs(surface.across.dot(extent));
  const double height = std::abs(surface.along.dot(extent));
  surface.size = Vec3(width, height, 0);
  const Vec3 right = surface.origin + width * surface.across;
  surface.outline = {surface.origin, right, right + height * surface.along,
                     surface.origin + height * surface.along};
  const auto isClosed = [&](const Vec3& direction) {
    Eigen::Index k = 0;
    direction.cwiseAbs().maxCoeff(&k);
    return !room.open[static_cast<std::size_t>(2 * k) + (direction[k] > 0 ? 1 : 0)];
  };
  surface.adjoins = {isClosed(-surface.across), isClosed(surface.across), isClosed(-surface.along),
                     isClosed(surface.along)};
  surface.covering = axis == 2 ? (isMax ? Covering::kPlain : Covering::kTiles) : Covering::kSkirted;
  surface.color = axis == 2 && !isMax ? materials.floor : materials.wall;
  return surface;
}

Vec3 footOf(const Plane& wall, const Vec3& point) {
  return point - (wall.normal.dot(point) - wall.offset) * wall.normal;
}

// A square in the wall's plane, large enough to cover the extent, clipped to the extent. What is on a wall
// that moves goes with it.
Surface slab(const Plane& plane, const Extent& extent, const Materials& materials, double time) {
  const Plane wall = plane.at(time);
  const Plane home = plane.at(0);
  Surface surface;
  surface.normal = wall.normal;
  std::tie(surface.across, surface.along) = directionsOn(plane, time);
  const Vec3 middle = footOf(wall, extent.centre());
  surface.origin = middle;
  if (!plane.course.empty()) {
    const Pose from = plane.frameAt(0);
    surface.origin = plane.frameAt(time).worldPoint(from.worldFromBody.transpose() *
                                                    (footOf(home, extent.centre()) - from.position));
  }
  const double reach = 2 * extent.radius();
  const Vec3 across = reach * surface.across;
  const Vec3 along = reach * surface.along;
  surface.outline = {middle - across - along, middle + across - along, middle + across + along,
                     middle - across + along};
  for (int axis = 0; axis < 3; ++axis) {
    surface.outline = clipped(surface.outline, Vec3::Unit(axis), extent.min[axis]);
    surface.outline = clipped(surface.outline, -Vec3::Unit(axis), -extent.max[axis]);
  }
  surface.covering = Covering::kTiles;
  surface.color = isLevel(home.normal) ? materials.floor : materials.slab;
  return surface;
}

// If boxes go beyond the surface's end: a rectangle that holds both, with a margin in which it fades.
void extend(Surface& surface, const WallReach& reach, double margin) {
  WallReach bounds;
  for (const Vec3& corner : surface.outline) {
    bounds.add(Vec2(surface.across.dot(corner), surface.along.dot(corner)), 0);
  }
  const bool isWithin = !bounds.isEmpty() && (bounds.min.array() <= reach.min.array()).all() &&
                        (reach.max.array() <= bounds.max.array()).all();
  if (reach.isEmpty() || isWithin) {
    return;
  }
  bounds.add(reach.min, 0);
  bounds.add(reach.max, 0);
  const Vec3 foot = surface.normal.dot(surface.origin) * surface.normal;
  const auto at = [&](double across, double along) -> Vec3 {
    return foot + across * surface.across + along * surface.along;
  };
  const Vec2 min = bounds.min.array() - margin;
  const Vec2 max = bounds.max.array() + margin;
  surface.outline = {at(min.x(), min.y()), at(max.x(), min.y()), at(max.x(), max.y()), at(min.x(), max.y())};
  surface.fade = margin;
}

}  // namespace

std::vector<Vec3> clipped(const std::vector<Vec3>& outline, const Vec3& normal, double offset) {
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3& from = outline[i];
    const Vec3& to = outline[(i + 1) % outline.size()];
    const double before = normal.dot(from) - offset;
    const double after = normal.dot(to) - offset;
    if (before >= 0) {
      kept.push_back(from);
    }
    if ((before >= 0) != (after >= 0)) {
      kept.emplace_back(from + before / (before - after) * (to - from));
    }
  }
  return kept;
}

double tileSize(const Extent& extent) {
  const double wanted = extent.radius() / 7;
  const double power = std::pow(10, std::floor(std::log10(wanted)));
  for (const double step : {5.0, 2.0}) {
    if (wanted >= step * power) {
      return step * power;
    }
  }
  return power;
}

std::vector<Surface> surfacesOf(const Stage& stage, const Extent& extent, const Materials& materials,
                                std::span<const WallReach> reaches, double time) {
  std::vector<Surface> surfaces;
  if (stage.room) {
    for (std::size_t side = 0; side < kRoomSides.size(); ++side) {
      if (!stage.room->open[side]) {
        surfaces.push_back(roomSide(*stage.room, side, materials));
      }
    }
  }
  // Without a room to bound it, a wall extends beyond the extent.
  Extent reach = extent;
  if (!stage.room) {
    const Vec3 margin = Vec3::Constant(extent.radius());
    reach = {.min = extent.min - margin, .max = extent.max + margin};
  }
  for (std::size_t wall = 0; wall < stage.planes.size(); ++wall) {
    Surface surface = slab(stage.planes[wall], reach, materials, time);
    if (wall < reaches.size()) {
      extend(surface, reaches[wall], extent.radius());
    }
    if (surface.outline.size() < 3) {
      surface.outline.clear();
    }
    if (!stage.planes[wall].course.empty()) {
      surface.plane = static_cast<int>(wall);
    }
    if (!surface.outline.empty() || surface.plane >= 0) {
      surfaces.push_back(std::move(surface));
    }
  }
  return surfaces;
}

}  // namespace careen
