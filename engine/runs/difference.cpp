#include "runs/difference.h"

#include <algorithm>
#include <cmath>

namespace careen {

std::vector<BodyState> withPoses(const World& world, std::span<const Pose> boxes) {
  std::vector<BodyState> states;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    states.push_back({.pose = bodyPose(world.bodies[i], boxes[i])});
  }
  return states;
}

PoseDifference differenceOf(const World& world, std::span<const BodyState> a, std::span<const BodyState> b) {
  PoseDifference worst;
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    const Body& body = world.bodies[i];
    if (!isImmovable(body.mass)) {
      worst.include(differenceOf(a[i].pose, b[i].pose, body.halfExtents.norm()));
    }
  }
  return worst;
}

double displacementOf(const World& world, std::span<const BodyState> a, std::span<const BodyState> b) {
  double worst = 0;
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    const Body& body = world.bodies[i];
    if (!isImmovable(body.mass)) {
      const double size = body.halfExtents.norm();
      const PoseDifference apart = differenceOf(a[i].pose, b[i].pose, size);
      const double turned = std::isfinite(apart.angle) ? 2 * std::sin(apart.angle / 2) : INFINITY;
      worst = std::max(worst, apart.position + turned * size);
    }
  }
  return worst;
}

}  // namespace careen
