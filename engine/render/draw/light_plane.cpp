#include "render/draw/light_plane.h"

#include <algorithm>
#include <cmath>

#include "view/camera.h"

namespace careen {
namespace {

constexpr int kMostCells = 64;

Mat3 lightFromWorld(const Vec3& towards) {
  const Vec3 up = std::abs(towards.z()) < 0.99 ? Vec3::UnitZ() : Vec3::UnitY();
  return lookAt(towards, Vec3::Zero(), up).transpose();
}

}  // namespace

LightPlane::LightPlane(const Vec3& towards, std::span<const DrawnBox> boxes)
    : towards_(towards), lightFromWorld_(lightFromWorld(towards)) {
  Vec3 most = Vec3::Zero();
  bounds_.reserve(boxes.size());
  for (const DrawnBox& box : boxes) {
    const Vec3 centre = seen(box.pose.position);
    const Vec3 reach = (lightFromWorld_ * box.pose.worldFromBody).cwiseAbs() * box.halfExtents;
    bounds_.push_back({.min = centre - reach, .max = centre + reach});
    origin_ = bounds_.size() == 1 ? bounds_[0].min : Vec3(origin_.cwiseMin(centre - reach));
    most = bounds_.size() == 1 ? bounds_[0].max : Vec3(most.cwiseMax(centre + reach));
  }
  cells_ = std::clamp(static_cast<int>(2 * std::sqrt(static_cast<double>(boxes.size()))), 1, kMostCells);
  const Vec3 size = most - origin_;
  cell_ = std::max({size.x(), size.y(), 1e-300}) / cells_;
  foundBy_.resize(boxes.size());
  content_.resize(static_cast<std::size_t>(cells_) * static_cast<std::size_t>(cells_));
  for (std::size_t box = 0; box < bounds_.size(); ++box) {
    const std::array<int, 2> from = cellOf(bounds_[box].min);
    const std::array<int, 2> to = cellOf(bounds_[box].max);
    for (int y = from[1]; y <= to[1]; ++y) {
      for (int x = from[0]; x <= to[0]; ++x) {
        content_[static_cast<std::size_t>(y) * static_cast<std::size_t>(cells_) + static_cast<std::size_t>(x)]
            .push_back(box);
      }
    }
  }
}

std::array<int, 2> LightPlane::cellOf(const Vec3& seen) const {
  const auto index = [&](Eigen::Index axis) {
    return static_cast<int>(std::clamp(std::floor((seen[axis] - origin_[axis]) / cell_), 0.0, cells_ - 1.0));
  };
  return {index(0), index(1)};
}

void LightPlane::gather(const Vec3& least, const Vec3& most, std::vector<std::size_t>& found) {
  found.clear();
  ++search_;
  const std::array<int, 2> from = cellOf(least);
  const std::array<int, 2> to = cellOf(most);
  for (int y = from[1]; y <= to[1]; ++y) {
    for (int x = from[0]; x <= to[0]; ++x) {
      for (const std::size_t box : content_[static_cast<std::size_t>(y) * static_cast<std::size_t>(cells_) +
                                            static_cast<std::size_t>(x)]) {
        const Bounds& bounds = bounds_[box];
        if (foundBy_[box] != search_ && bounds.min.x() < most.x() && bounds.max.x() > least.x() &&
            bounds.min.y() < most.y() && bounds.max.y() > least.y() && bounds.max.z() > least.z()) {
          found.push_back(box);
          foundBy_[box] = search_;
        }
      }
    }
  }
}

Zonogon zonogonOf(const DrawnBox& box, const Vec3& towards) {
  constexpr double kLeastSlope = 1e-4;  // an axis this much across the light is passed nowhere near
  Zonogon zonogon{.centre = box.pose.position};
  const Vec3 light = box.pose.worldFromBody.transpose() * towards;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Vec3 normal = box.pose.worldFromBody.col(k).cross(towards);
    const double size = normal.norm();
    const Eigen::Index i = (k + 1) % 3;
    const Eigen::Index j = (k + 2) % 3;
    if (size > 1e-6) {
      zonogon.slabs.row(k) = normal.transpose() / size;
      zonogon.half[k] =
          (box.halfExtents[i] * std::abs(light[j]) + box.halfExtents[j] * std::abs(light[i])) / size;
    } else {
      zonogon.half[k] = 1e3 * box.halfExtents.norm();  // the other two slabs bound the box
    }
    const double slope = (light[k] < 0 ? -1 : 1) / std::max(std::abs(light[k]), kLeastSlope);
    zonogon.passing.row(k) = -slope * box.pose.worldFromBody.col(k).transpose();
    zonogon.halfPassing[k] = box.halfExtents[k] * std::abs(slope);
  }
  return zonogon;
}

void appendShadow(std::vector<float>& records, const Zonogon& zonogon, const Vec3& point,
                  const std::array<float, 3>& offset, double weight) {
  const Vec3 from = point - zonogon.centre;
  records.insert(records.end(), offset.begin(), offset.end());
  append(records, zonogon.slabs * from);
  append(records, zonogon.passing * from);
  append(records, zonogon.half);
  append(records, zonogon.halfPassing);
  records.push_back(static_cast<float>(weight));
}

}  // namespace careen
